// A model bound to a cage: weights, rest positions, and derived data.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "pose/cage.h"
#include "pose/deformer.h"

namespace viete::weights {

struct TiledBinding;

using mesh::picked, mesh::Vec3;

/// One factor s per vertex, in the model's order: 0 keeps the vertex at rest, 1 is full motion. If the vector
/// is empty, all factors are 1. The factor multiplies the vertex's offset and its blended sums (see RowForm).
/// Then (1 - s) * x is added to the blended centre, where x is the vertex at rest. This requires that the
/// origin of all poses is the middle of the rest cage.
using Shares = std::vector<double>;

/// Factors from 0 to 1 that users paint on vertices; null if all are 1. A mask does not change the binding.
using Mask = std::shared_ptr<const std::vector<float>>;

/// Vertex positions to deform instead of the rest positions, or null. Weights are always computed at rest.
using SharedShape = std::shared_ptr<const std::vector<mesh::Point>>;

struct Binding {
  pose::Weighting weighting;
  std::size_t vertices = 0, handles = 0;  ///< vertices include tips
  /// For a capture: the distance of the tips, see deform/splats.h. A quarter of the vertices are splats, and
  /// the others are tips. 0 for other models.
  double tip_step = 0;
  std::shared_ptr<const TiledBinding> tiles;  ///< for the fused and the stitched engine; may be null
  SharedShape rest;                           ///< rest positions of the model; not null
  Vec3 rest_origin{0, 0, 0};                  ///< the middle of the rest cage
  std::vector<std::string> warnings;

  // Only the staged engine uses the members below. For other engines, the members below are empty.
  std::vector<double> weights;  ///< [vertex][handle]; a row sums to 1, or to 0 if the vertex's share is 0
  Shares shares;                ///< empty unless weights are partial (see Weighting)
  std::vector<mesh::Point> offsets;  ///< rest position minus the weighted mean of the handles' rest centres
  std::shared_ptr<const mesh::Surface> model;  ///< null for a part of a model
  mesh::Adjacency around;

  /// The number of vertices of the model, without tips.
  std::size_t model_vertices() const { return tip_step > 0 ? vertices / 4 : vertices; }
};

/// Returns the vertices' displacements from `rest` to `shape`. If `shape` is null, returns an empty vector.
std::vector<Vec3> displacements_of(const SharedShape& shape, std::span<const mesh::Point> rest);

/// The vertices of a binding with the current shares and shape. Refers to data that must outlive this object.
struct VertexBlock {
  const Binding& binding;
  std::span<const double> shares{};       ///< see Shares
  std::span<const Vec3> displacements{};  ///< displacements of the shape from rest; if empty, all are 0

  double share(std::size_t i) const { return shares.empty() ? 1 : shares[i]; }
  Vec3 rest(std::size_t i) const { return shaped(*binding.rest, i); }
  Vec3 offset(std::size_t i) const { return shaped(binding.offsets, i); }

private:
  Vec3 shaped(const std::vector<Vec3>& at_rest, std::size_t i) const {
    return displacements.empty() ? at_rest[i] : at_rest[i] + displacements[i];
  }
};

template <class Vector>
void drop_whole(Vector& shares) {
  if (std::ranges::all_of(shares, [](auto s) { return s == 1; })) shares.clear();
}

inline std::span<const float> values(const Mask& mask) {
  return mask ? std::span<const float>(*mask) : std::span<const float>();
}
/// Returns the products of shares and mask values. If an argument is empty, its values count as 1.
Shares product(Shares shares, std::span<const float> mask);

/// Writes the weights of a vertex. Thread-safe.
using KnownRow = std::function<void(std::uint32_t vertex, std::span<double> row)>;

/// Returns warnings about mean value coordinates: an open cage, flipped or ignored triangles, and vertices
/// without coordinates (their number is `failed`). For other weights, returns no warnings.
std::vector<std::string> weight_warnings(const pose::Cage& cage, pose::Weights weights, std::size_t failed,
                                         std::size_t vertices);

/// Returns `bytes` as the memory need of a binding, with the error text for insufficient memory.
base::MemoryNeed binding_memory(double bytes, std::size_t vertices, std::size_t handles);

}  // namespace viete::weights
