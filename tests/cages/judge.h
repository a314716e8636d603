// Checks cages, without the code that makes cages.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cages/wish.h"
#include "mesh/defects.h"
#include "mesh/summary.h"
#include "mesh/triangle.h"
#include "mesh/triangle_tree.h"

namespace viete::test {

/// Returns the model's triangles. If the model has no triangles, returns each point as a degenerate triangle.
inline std::vector<mesh::Triangle> pieces_of(const mesh::Surface& model) {
  if (!model.triangles.empty()) return model.triangles;
  std::vector<mesh::Triangle> points;
  for (std::uint32_t v = 0; v < model.positions.size(); ++v) points.push_back({v, v, v});
  return points;
}

inline double extent_of(const mesh::Surface& model) {
  return (model.triangles.empty() ? mesh::bounds(model.positions) : mesh::used_bounds(model)).diagonal();
}

/// Returns the smallest distance between cage and model, relative to the model's size. Tests every pair.
inline double least_distance(const mesh::Surface& cage, const mesh::Surface& model) {
  const double unit = extent_of(model);
  double least = unit;
  const auto pieces = pieces_of(model);
  for (const auto& t : cage.triangles) {
    const mesh::Corners side = mesh::corners_of(cage.positions, t);
    mesh::Bounds box = mesh::bounds(side);
    for (const auto& piece : pieces) {
      const mesh::Corners corners = mesh::corners_of(model.positions, piece);
      const mesh::Bounds other = mesh::bounds(corners);
      double apart = 0;  // the distance between the boxes
      for (std::size_t k = 0; k < 3; ++k)
        apart = std::max({apart, box.low[k] - other.high[k], other.low[k] - box.high[k]});
      if (apart >= least) continue;
      least = std::min(least, std::sqrt(mesh::squared_distance(side, corners)));
    }
  }
  return least / unit;
}

/// Mirrors all vertices. Returns the largest distance from a mirrored vertex to the nearest vertex.
inline double asymmetry(const mesh::Surface& cage, const cages::Plane& plane) {
  using namespace mesh;
  double most = 0;
  for (const Point& p : cage.positions) {
    const Point image = p - (2 * (dot(plane.normal, p) - plane.offset)) * plane.normal;
    double least = HUGE_VAL;
    for (const Point& q : cage.positions) least = std::min(least, largest_abs(image - q));
    most = std::max(most, least);
  }
  return most;
}

inline bool some_note_holds(const cages::Made& made, const std::string& words) {
  return std::ranges::any_of(made.notes, [&](const auto& note) { return note.find(words) != note.npos; });
}

/// Returns descriptions of the cage's defects. If the cage has no defects, the result is empty.
inline std::vector<std::string> complaints(const cages::Made& made, const mesh::Surface& model,
                                           const cages::Wish& wish) {
  std::vector<std::string> all;
  const mesh::Surface& cage = made.surface;
  const mesh::Summary summary = mesh::summarize(cage);
  const auto topology = mesh::topology(cage, summary);
  if (!topology) return {"not an oriented manifold"};
  if (!summary.closed()) all.push_back("open");
  if (!summary.unused_vertices.empty()) all.push_back("unused vertices");
  if (!(summary.volume > 0)) all.push_back("inside out");
  if (!mesh::self_intersecting_triangles(cage).empty()) all.push_back("cuts itself");
  const double least = least_distance(cage, model);
  if (least <= 0) all.push_back("cut by the model");
  const bool keeps_margin = wish.effort == cages::Effort::full || wish.kind != cages::Kind::automatic;
  if (keeps_margin && least < wish.margin * (1 - 1e-6) &&
      !some_note_holds(made, "the margin could not be kept"))
    all.push_back("margin " + std::to_string(100 * least) + " %, nothing said");
  const auto is_inside = [&](const mesh::Triangle& piece) {
    return std::abs(mesh::winding_number(cage, model.positions[piece[0]]) - 1) < 1e-3;
  };
  if (!std::ranges::all_of(pieces_of(model), is_inside)) all.push_back("not all of the model inside");
  const mesh::Summary of_model = mesh::summarize(model);
  const bool solid = of_model.closed() && of_model.parts == 1 && mesh::topology(model, of_model) &&
                     mesh::self_intersecting_triangles(model).empty();
  if (solid && summary.volume < std::abs(of_model.volume)) all.push_back("smaller than the model");
  if (wish.kind != cages::Kind::box && made.notes.empty()) {
    const double share = static_cast<double>(summary.triangles) / static_cast<double>(wish.triangles);
    if (share > 1.1 || (share < 0.9 && wish.kind == cages::Kind::automatic))
      all.push_back(std::to_string(summary.triangles) + " triangles, nothing said");
  }
  if (made.mirror) {
    const mesh::Bounds box = mesh::bounds(cage.positions);
    const double size = box.diagonal() + mesh::largest_abs(box.center());
    if (!(asymmetry(cage, *made.mirror) < 1e-13 * size)) all.push_back("not symmetric");
  }
  return all;
}

}  // namespace viete::test
