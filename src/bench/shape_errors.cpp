#include "bench/shape_errors.h"

#include <algorithm>
#include <cmath>

namespace viete::bench {

namespace {

double length(std::span<const mesh::Point> p, const mesh::Edge& e) {
  return mesh::norm(p[e[0]] - p[e[1]]);
}

}  // namespace

ShapeErrors::ShapeErrors(const mesh::Surface& rest)
    : edges_(mesh::polygon_edges(rest)), diagonal_(mesh::bounds(rest.positions).diagonal()) {}

EdgeErrors ShapeErrors::edges(std::span<const mesh::Point> a, std::span<const mesh::Point> b,
                              std::span<const mesh::Point> shape) const {
  std::vector<double> errors;
  double squares = 0;
  for (const mesh::Edge& e : edges_) {
    const double expected = std::sqrt(length(a, e) * length(b, e));
    if (!(expected > 0)) continue;
    errors.push_back(std::abs(std::log(length(shape, e) / expected)));
    squares += errors.back() * errors.back();
  }
  std::ranges::sort(errors);
  const auto count = errors.size();
  return {std::sqrt(squares / static_cast<double>(count)), errors[count * 95 / 100],
          errors[count * 99 / 100]};
}

double ShapeErrors::distance(std::span<const mesh::Point> a, std::span<const mesh::Point> b) const {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += mesh::norm(a[v] - b[v]);
  return sum / (static_cast<double>(a.size()) * diagonal_);
}

double ShapeErrors::farthest(std::span<const mesh::Point> a, std::span<const mesh::Point> b) const {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) {
    const double off = mesh::norm(a[v] - b[v]);
    largest = std::isnan(largest) || off <= largest ? largest : off;  // NaN counts
  }
  return largest / diagonal_;
}

std::vector<std::uint32_t> far_vertices(std::span<const mesh::Point> positions, std::size_t count) {
  mesh::Point mean{0, 0, 0};
  for (const mesh::Point& p : positions) mean = mean + (1 / static_cast<double>(positions.size())) * p;
  std::vector<double> distances;
  for (const mesh::Point& p : positions) distances.push_back(mesh::norm(p - mean));
  std::vector<std::uint32_t> far;
  while (far.size() < std::min(count, positions.size())) {
    const auto v = static_cast<std::uint32_t>(std::ranges::max_element(distances) - distances.begin());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double distance = mesh::norm(positions[i] - positions[v]);
      distances[i] = far.empty() ? distance : std::min(distances[i], distance);
    }
    far.push_back(v);
  }
  return far;
}

}  // namespace viete::bench
