#include "cages/frame.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "mesh/summary.h"

namespace viete::cages {

namespace {

using Matrix = std::array<Vec3, 3>;

// Columns of the eigenvectors, by rotations (Jacobi).
Matrix eigenvectors(Matrix a) {
  Matrix v = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < 12; ++sweep) {
    for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
      if (std::abs(a[p][q]) < 1e-300) continue;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = std::copysign(1, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = a[k][p], y = a[k][q];
        a[k][p] = c * x - s * y;
        a[k][q] = s * x + c * y;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = a[p][k], y = a[q][k];
        a[p][k] = c * x - s * y;
        a[q][k] = s * x + c * y;
        const double u = v[k][p], w = v[k][q];
        v[k][p] = c * u - s * w;
        v[k][q] = s * u + c * w;
      }
    }
  }
  return v;
}

mesh::Bounds extent_of(const mesh::Surface& surface) {
  return surface.triangles.empty() ? mesh::bounds(surface.positions) : mesh::used_bounds(surface);
}

// Calls visit(place, weight) so that moments up to the second are those of the triangles' areas; of points
// where there are no areas.
template <class Visit>
void for_moments(const mesh::Surface& surface, const Frame& frame, bool has_area, Visit&& visit) {
  if (!has_area) {
    for (const Point& p : surface.positions) visit(frame.into(p), 1.0);
    return;
  }
  for (const auto& t : surface.triangles) {
    const Point a = frame.into(surface.positions[t[0]]), b = frame.into(surface.positions[t[1]]),
                c = frame.into(surface.positions[t[2]]);
    const double weight = mesh::norm(mesh::cross(b - a, c - a)) / 12;
    for (const Point& p : {a, b, c}) visit(p, weight);
    visit((1.0 / 3) * (a + b + c), 9 * weight);
  }
}

}  // namespace

Frame frame_of(const mesh::Surface& model, const std::optional<Plane>& mirror) {
  const mesh::Bounds box = extent_of(model);
  Frame frame{box.center(), 1 / box.diagonal()};
  if (!mirror) return frame;
  const Vec3& n = mirror->normal;
  frame.center = frame.center - (mesh::dot(n, frame.center) - mirror->offset) * n;
  Vec3 least{0, 0, 0};
  least[static_cast<std::size_t>(std::ranges::min_element(n, {}, [](double x) { return std::abs(x); }) -
                                 n.begin())] = 1;
  const Vec3 u = mesh::cross(n, least);
  frame.axes[0] = n;
  frame.axes[1] = (1 / mesh::norm(u)) * u;
  frame.axes[2] = mesh::cross(n, frame.axes[1]);
  return frame;
}

Frame own_frame(const mesh::Surface& model) {
  Frame frame = frame_of(model, std::nullopt);
  double total = 0;
  Point mean{0, 0, 0};
  const auto add = [&](const Point& p, double weight) {
    total += weight;
    mean = mean + weight * p;
  };
  for_moments(model, frame, true, add);
  const bool has_area = total > 1e-12;
  if (!has_area) for_moments(model, frame, false, add);
  mean = (1 / total) * mean;
  Matrix inertia{};
  for_moments(model, frame, has_area, [&](const Point& p, double weight) {
    for (std::size_t i = 0; i < 3; ++i)
      inertia[i] = inertia[i] + (weight / total * (p[i] - mean[i])) * (p - mean);
  });
  const Matrix v = eigenvectors(inertia);
  frame.axes[0] = {v[0][0], v[1][0], v[2][0]};
  frame.axes[1] = {v[0][1], v[1][1], v[2][1]};
  frame.axes[2] = mesh::cross(frame.axes[0], frame.axes[1]);
  return frame;
}

FramedModel shape_in(const Frame& frame, const mesh::Surface& surface) {
  FramedModel model{surface.positions, surface.triangles, {}, false};
  for (Point& p : model.positions) p = frame.into(p);
  if (model.triangles.empty()) {
    for (std::uint32_t v = 0; v < model.positions.size(); ++v) model.triangles.push_back({v, v, v});
  }
  std::vector<std::uint32_t> used;
  for (const auto& t : model.triangles) used.insert(used.end(), t.begin(), t.end());
  model.box = mesh::bounds(model.positions, used);
  return model;
}

namespace {

// Of triangles with the same corners in the same direction, as a polygon that goes round more than once has
// them, the first.
void drop_copies(std::vector<mesh::Triangle>& triangles) {
  const auto from_lowest = [&](std::uint32_t i) {
    mesh::Triangle t = triangles[i];
    std::ranges::rotate(t, std::ranges::min_element(t));
    return t;
  };
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, from_lowest);
  std::vector<char> is_copy(triangles.size(), 0);
  for (std::size_t i = 1; i < order.size(); ++i)
    is_copy[order[i]] = from_lowest(order[i]) == from_lowest(order[i - 1]);
  std::size_t t = 0;
  std::erase_if(triangles, [&](const mesh::Triangle&) { return is_copy[t++] != 0; });
}

}  // namespace

FramedModel model_in(const Frame& frame, const mesh::Surface& surface) {
  FramedModel model = shape_in(frame, surface);
  const std::size_t all = model.triangles.size();
  drop_copies(model.triangles);
  const mesh::Summary summary = mesh::summarize(
      model.triangles.size() == all ? surface : mesh::from_triangles(surface.positions, model.triangles));
  model.closed = summary.closed() && summary.manifold() && summary.oriented();
  return model;
}

}  // namespace viete::cages
