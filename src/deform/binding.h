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

}  // namespace viete::deform
