// How far shapes of a model are from what is expected, in numbers that no unit of length changes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/half_edges.h"
#include "mesh/surface.h"

namespace viete::bench {

/// Of |log| of edges' lengths over the expected ones; edges without length do not count.
struct EdgeErrors {
  double root_mean_square, share_95, share_99;  ///< 95 % and 99 % of them are at most that
};

/// A model and its edges.
class ShapeErrors {
public:
  explicit ShapeErrors(const mesh::Surface& rest);

  /// Expected is the geometric mean of an edge's lengths in a and in b.
  EdgeErrors edges(std::span<const mesh::Point> a, std::span<const mesh::Point> b,
                   std::span<const mesh::Point> shape) const;
  /// Between vertices: their mean, in diagonals of the model at rest.
  double distance(std::span<const mesh::Point> a, std::span<const mesh::Point> b) const;
  /// The largest one.
  double farthest(std::span<const mesh::Point> a, std::span<const mesh::Point> b) const;

private:
  std::vector<mesh::Edge> edges_;
  double diagonal_;
};

/// The vertex farthest from the mean of all, then each time the one that is farthest from those: extremities.
std::vector<std::uint32_t> far_vertices(std::span<const mesh::Point> positions, std::size_t count);

}  // namespace viete::bench
