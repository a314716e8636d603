// A model bound to a cage: weights, rest positions, and their by-products.
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

/// How much of its motion each vertex makes, 0 to 1: its share. Sums of rows count so many times, and what
/// they miss is the vertex as it is at rest, so that its maps are completed by the identity about itself:
/// with a share s its offset is o = s (x - sum w c), and its centre s sum w c' + (1 - s) x. Where vertices
/// have shares poses are relative to the middle of the rest cage. In the order of the model; empty: all of
/// it.
using Shares = std::vector<double>;

/// A share of every vertex, painted; null: all of it. It is not of a binding: those serve any.
using Mask = std::shared_ptr<const std::vector<float>>;

/// Where a model's vertices are before the cage moves them, one position each; null: at rest. Weights stay
/// those at rest.
using SharedShape = std::shared_ptr<const std::vector<mesh::Point>>;

/// n vertices, k handles.
struct Binding {
  Weighting weighting;
  std::size_t vertices = 0, handles = 0;
  std::shared_ptr<const TiledBinding> tiles;  ///< for the fused engine; null where it is not for that
  std::vector<mesh::Point> rest;              ///< x, the model's positions
  std::vector<std::string> warnings;

  // The rest is for the staged engine, and empty where it is not for that.
  Vec3 rest_origin{0, 0, 0};    ///< the middle of the rest cage
  std::vector<double> weights;  ///< n rows of k, each summing to 1, or to 0 where the share is 0
  Shares shares;                ///< empty unless weights are partial (see Weighting)
  std::vector<mesh::Point>
      offsets;  ///< x - sum w c, c the handles' rest centres: what weights do not reproduce
  std::vector<mesh::Triangle> triangles;  ///< of the model
  mesh::Adjacency around;
};

/// How far its vertices are from rest; empty: at rest.
std::vector<Vec3> ways_of(const SharedShape& shape, std::span<const mesh::Point> rest);
/// Rest and offsets are those of a shape, from now on: so far from where they were, one way each, or none.
void shape_by(Binding& binding, std::span<const Vec3> ways);

/// Empties shares that are all 1.
template <class Vector>
void drop_whole(Vector& shares) {
  if (std::ranges::all_of(shares, [](auto s) { return s == 1; })) shares.clear();
}

/// Both together.
Shares product(Shares shares, const Mask& mask);

/// What a person should know of the weights: of mean values where the cage is not closed, and of so many
/// vertices that have none.
std::vector<std::string> weight_warnings(const Cage& cage, Weights weights, std::size_t failed,
                                         std::size_t vertices);

/// What a binding of so many bytes says when they are not to be had.
base::MemoryNeed binding_memory(double bytes, std::size_t vertices, std::size_t handles);

/// Bytes that bind() asks for before it begins, for n vertices and k handles; at most 2^63. For the fused
/// engine: at most, or where weights can be compressed (those of affine maps), a quarter of that, of which
/// less is left by the compression. Weights along the surface are of all vertices before they are compressed.
std::size_t binding_bytes(std::size_t vertices, std::size_t handles, EngineKind engine = EngineKind::staged,
                          const Weighting& weighting = {});

/// For the staged engine. Cost O(n k), shared over the pool; the result does not depend on the number of
/// threads. Throws base::Cancelled; throws base::Error when the memory that is free now would not suffice,
/// when the model has no vertices, or, for weights along its surface, no triangles.
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, base::WorkerPool& pool,
             base::Progress* progress = nullptr);

/// For the engine; of `known`, a binding of the same model and cage or null, what fits is shared. As bind().
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, EngineKind engine,
             const Binding* known, base::WorkerPool& pool, base::Progress* progress = nullptr);

}  // namespace viete::deform
