#include "bench/rest_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/median.h"
#include "mesh/half_edges.h"
#include "mesh/summary.h"
#include "mesh/triangle.h"

namespace viete::bench {

namespace {

using mesh::cross, mesh::dot, mesh::norm, mesh::Point, mesh::squared_norm;

bool has_area(std::span<const Point> p, const mesh::Triangle& t) {
  return mesh::has_area(p[t[0]], p[t[1]], p[t[2]]);
}

double area_of(std::span<const Point> p, const mesh::Triangle& t) {
  return norm(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2;
}

// Of tetrahedra from one of its points, so that nothing is lost far from the origin.
double volume_of(std::span<const Point> p, std::span<const mesh::Triangle> triangles) {
  const Point& apex = p[triangles[0][0]];
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += dot(p[a] - apex, cross(p[b] - apex, p[c] - apex));
  return sum / 6;
}

// Between the normals of the triangles a b c and b a d; 0 where they lie in a plane.
double hinge_angle(std::span<const Point> p, const std::array<std::uint32_t, 4>& corners) {
  const auto& [a, b, c, d] = corners;
  const Point edge = p[b] - p[a], n = cross(edge, p[c] - p[a]), m = cross(p[d] - p[a], edge);
  return std::atan2(dot(edge, cross(n, m)) / norm(edge), dot(n, m));
}

std::uint32_t opposite(const mesh::Triangle& t, const mesh::Edge& edge) {
  return *std::find_if(t.begin(), t.end(), [&](auto v) { return v != edge[0] && v != edge[1]; });
}

}  // namespace

RestModel::RestModel(const mesh::Surface& model) : positions_(model.positions), triangles_(model.triangles) {
  add_faces(model);
  add_hinges(model);
  const mesh::Summary summary = mesh::summarize(model);
  if (summary.closed() && summary.oriented()) volume_ = volume_of(positions_, triangles_);
}

void RestModel::add_faces(const mesh::Surface& model) {
  shares_.resize(positions_.size());
  for (const mesh::Triangle& t : model.triangles) {
    const auto face = lab::flat_face(positions_, t);
    if (!face) {
      ++without_area_;
      continue;
    }
    faces_.push_back(*face);
    area_ += faces_.back().area();
    for (const auto corner : t) shares_[corner] += faces_.back().area();
  }
  if (faces_.empty()) throw base::Error("", "the model has no triangle with area", "choose another one");
  for (double& share : shares_) share /= 3 * area_;
}

void RestModel::add_hinges(const mesh::Surface& model) {
  const mesh::HalfEdges table = mesh::half_edges(positions_.size(), model.triangles);
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto sides = table.of(e);
    if (sides.size() != 2) continue;
    const mesh::Edge& edge = table.edges[e];
    const auto &first = model.triangles[sides[0].triangle], &second = model.triangles[sides[1].triangle];
    if (!has_area(positions_, first) || !has_area(positions_, second)) continue;
    Hinge hinge{{edge[0], edge[1], opposite(first, edge), opposite(second, edge)}, 0, 0};
    hinge.weight = 3 * squared_norm(positions_[edge[1]] - positions_[edge[0]]) /
                   (area_of(positions_, first) + area_of(positions_, second));
    hinge.angle = hinge_angle(positions_, hinge.corners);
    hinges_.push_back(hinge);
  }
}

Distortion RestModel::distortion(std::span<const Point> positions) const {
  Distortion result;
  std::vector<double> shears;
  shears.reserve(faces_.size());
  for (const lab::FlatFace& f : faces_) {
    const auto [x, y] = lab::plane_map(f, positions);  // columns of J, in space
    const double xx = squared_norm(x), yy = squared_norm(y);
    const bool lost = !has_area(positions, f.corners);
    const double stretch = lost ? 0 : norm(cross(x, y));                       // of area: det J
    const double larger = (xx + yy + std::hypot(xx - yy, 2 * dot(x, y))) / 2;  // squared
    shears.push_back(larger / stretch);
    result.energy += f.area() / area_ * ((xx + yy) * (1 + 1 / (stretch * stretch)) - 4);
    result.collapsed += lost;
  }
  // A triangle that has shrunk to a point has no shear to speak of, but has collapsed all the same.
  for (double& shear : shears) shear = std::isnan(shear) ? std::numeric_limits<double>::infinity() : shear;
  if (result.collapsed) result.energy = std::numeric_limits<double>::infinity();
  result.worst_shear = *std::max_element(shears.begin(), shears.end());
  result.median_shear = base::median(std::move(shears));
  return result;
}

double RestModel::bending(std::span<const Point> positions) const {
  double sum = 0;
  for (const Hinge& hinge : hinges_) {
    const double turned =
        std::remainder(hinge_angle(positions, hinge.corners) - hinge.angle, 2 * std::numbers::pi);
    sum += hinge.weight * turned * turned;
  }
  return sum;
}

double RestModel::volume(std::span<const Point> positions) const {
  return encloses() ? volume_of(positions, triangles_) / volume_ : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace viete::bench
