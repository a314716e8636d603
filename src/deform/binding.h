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

/// Share of its motion that each vertex makes, 0 to 1. Sums of rows are multiplied by it, and the rest stays:
/// maps are completed by the identity about the vertex. With a share s the offset is o = s (x - sum w c), and
/// the centre s sum w c' + (1 - s) x. With shares, poses are relative to the middle of the rest cage. In the
/// order of the model; empty: all 1.
using Shares = std::vector<double>;

/// A painted share per vertex; null: all 1. Independent of the binding.
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
/// Replaces rest and offsets by those of a shape; ways: displacements from the current rest, or empty.
void shape_by(Binding& binding, std::span<const Vec3> ways);

/// Clears shares that are all 1.
template <class Vector>
void drop_whole(Vector& shares) {
  if (std::ranges::all_of(shares, [](auto s) { return s == 1; })) shares.clear();
}

/// Shares times mask.
Shares product(Shares shares, const Mask& mask);

/// Warnings about weights: mean value coordinates of a cage that is not closed, and the number of vertices
/// that have none.
std::vector<std::string> weight_warnings(const Cage& cage, Weights weights, std::size_t failed,
                                         std::size_t vertices);

/// The memory of a binding of this many bytes, with the text of the error if it is not available.
base::MemoryNeed binding_memory(double bytes, std::size_t vertices, std::size_t handles);

/// Bytes that bind() requires before it begins, for n vertices and k handles; at most 2^63. For the fused
/// engine an upper bound, or a quarter of it if weights can be compressed (those of affine maps); the
/// compressed size is smaller. Weights along the surface are computed for all vertices before compression.
std::size_t binding_bytes(std::size_t vertices, std::size_t handles, EngineKind engine = EngineKind::staged,
                          const Weighting& weighting = {});

/// Binds for the staged engine. Cost O(n k), shared over the pool; the result does not depend on the number
/// of threads. Throws base::Cancelled; throws base::Error if free memory is insufficient, the model has no
/// vertices or, for weights along its surface, no triangles.
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, base::WorkerPool& pool,
             base::Progress* progress = nullptr);

/// Binds for this engine, sharing data of `known` (same model and cage, or null) if possible. As bind().
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, EngineKind engine,
             const Binding* known, base::WorkerPool& pool, base::Progress* progress = nullptr);

}  // namespace viete::deform
