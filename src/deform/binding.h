// A model bound to a cage: weights, rest positions, and derived data.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/cage.h"
#include "deform/scheme.h"
#include "mesh/adjacency.h"

namespace viete::deform {

struct TiledBinding;

/// Share of the full motion for each vertex, 0 (stays) to 1. Multiplies sums of rows; the remaining share is
/// filled up by the identity about the vertex. With a share s the offset is o = s (x - sum w c), and
/// the centre s sum w c' + (1 - s) x. With shares, poses are relative to the middle of the rest cage. In the
/// order of the model; empty: all 1.
using Shares = std::vector<double>;

/// The painted share of the deformation that each vertex follows; null: all 1. Independent of the binding.
using Mask = std::shared_ptr<const std::vector<float>>;

/// Vertex positions before the cage deformation, one per vertex; null: at rest. Weights stay those of the
/// rest positions.
using SharedShape = std::shared_ptr<const std::vector<mesh::Point>>;

/// n vertices, k handles.
struct Binding {
  Weighting weighting;
  std::size_t vertices = 0, handles = 0;
  std::shared_ptr<const TiledBinding> tiles;  ///< for the fused engine; null if not bound for it
  std::vector<mesh::Point> rest;              ///< x, the model's positions
  std::vector<std::string> warnings;

  // Members below are for the staged engine; empty if not bound for it.
  Vec3 rest_origin{0, 0, 0};    ///< the middle of the rest cage
  std::vector<double> weights;  ///< n rows of k, each summing to 1, or to 0 where the share is 0
  Shares shares;                ///< empty unless weights are partial (see Weighting)
  std::vector<mesh::Point>
      offsets;  ///< x - sum w c, c the handles' rest centres: what weights do not reproduce
  std::vector<mesh::Triangle> triangles;  ///< triangles of the model
  mesh::Adjacency around;
};

/// Displacements of a shape's vertices from rest; empty: at rest.
std::vector<Vec3> ways_of(const SharedShape& shape, std::span<const mesh::Point> rest);

/// The vertices of a binding in a frame. Refers to its parts.
struct VertexBlock {
  const Binding& binding;
  std::span<const double> shares{};  ///< see Shares
  std::span<const Vec3> ways{};      ///< displacements of the shape from rest; empty: at rest

  double share(std::size_t i) const { return shares.empty() ? 1 : shares[i]; }
  Vec3 rest(std::size_t i) const { return shaped(binding.rest, i); }
  Vec3 offset(std::size_t i) const { return shaped(binding.offsets, i); }

private:
  Vec3 shaped(const std::vector<Vec3>& at_rest, std::size_t i) const {
    return ways.empty() ? at_rest[i] : at_rest[i] + ways[i];
  }
};

/// The values at some vertices; empty if there are none.
template <class T, class Indices>
std::vector<T> picked(std::span<const T> values, const Indices& vertices) {
  std::vector<T> some;
  if (values.empty()) return some;
  for (const auto v : vertices) some.push_back(values[v]);
  return some;
}

/// Clears shares that are all 1.
template <class Vector>
void drop_whole(Vector& shares) {
  if (std::ranges::all_of(shares, [](auto s) { return s == 1; })) shares.clear();
}

inline std::span<const float> values(const Mask& mask) {
  return mask ? std::span<const float>(*mask) : std::span<const float>();
}
/// Shares times the values of a mask.
Shares product(Shares shares, std::span<const float> mask);

/// Warnings about weights: mean value coordinates of a cage that is not closed, and the number of vertices
/// that have none.
std::vector<std::string> weight_warnings(const Cage& cage, Weights weights, std::size_t failed,
                                         std::size_t vertices);

/// The memory of a binding of this many bytes, with the text of the error if it is not available.
base::MemoryNeed binding_memory(double bytes, std::size_t vertices, std::size_t handles);

}  // namespace viete::deform
