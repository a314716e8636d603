// The model bound to the cage: weights and everything that is computed once per model, cage and coordinates.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/cage.h"
#include "deform/weighting.h"
#include "mesh/adjacency.h"

namespace viete::deform {

struct TiledBinding;

/// Which frames a binding is for: the links of the chain one by one, in double, or the fused frame.
enum class Path { staged, fused };

/// n vertices, k handles (cage triangles or cage vertices).
struct Binding {
  Coordinates coordinates = Coordinates::face;
  double reach = whole_cage;
  std::size_t vertices = 0, handles = 0;
  std::shared_ptr<const TiledBinding> tiles;  ///< for the fused frame; null where it is not for that
  std::vector<double>
      weights;  ///< n rows of k, each summing to 1; empty where it is not for the staged frame
  std::vector<mesh::Point> rest;  ///< x, the model's positions
  /// Face: x - sum w c, which exp(Y) exp(X) acts on. Mean value: x - sum w p, what the weights cannot
  /// reproduce, ~0 for closed cages.
  std::vector<mesh::Point> offsets;
  std::vector<mesh::Triangle> triangles;  ///< of the model
  mesh::Adjacency around;
  std::vector<std::string> warnings;

  Weighting weighting() const { return {coordinates, reach}; }
};

/// What a person should know of the weights: of mean values where the cage is not closed, and of so many
/// vertices that have none.
std::vector<std::string> weight_warnings(const Cage& cage, Coordinates coordinates, std::size_t failed,
                                         std::size_t vertices);

/// Bytes that bind() asks for before it begins, for n vertices and k handles; at most 2^63. For the fused
/// frame: at most, or where weights can be compressed (those of faces), a quarter of that, of which less is
/// left by the compression.
std::size_t binding_bytes(std::size_t vertices, std::size_t handles, Path path = Path::staged,
                          Coordinates coordinates = Coordinates::face);

/// What a binding of so many bytes says when they are not to be had.
base::MemoryNeed binding_memory(double bytes, std::size_t vertices, std::size_t handles);

/// For the staged frame. Cost O(n k), shared over the pool; the result does not depend on the number of
/// threads. Throws base::Cancelled; throws base::Error when the memory that is free now would not suffice, or
/// when the model has no vertices.
Binding bind(const mesh::Surface& model, const Cage& cage, Weighting weighting, base::WorkerPool& pool,
             base::Progress* progress = nullptr);

/// For the path; of `known`, a binding of the same model and cage or null, what fits is shared. As bind().
Binding bind(const mesh::Surface& model, const Cage& cage, Weighting weighting, Path path,
             const Binding* known, base::WorkerPool& pool, base::Progress* progress = nullptr);

}  // namespace viete::deform
