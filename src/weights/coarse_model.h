// A coarse copy of a model that is large or has no faces, for solves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"
#include "pose/cage.h"
#include "sym3/small_matrices.h"
#include "weights/binding.h"
#include "weights/surface_proxy.h"

namespace viete::weights {

/// A lattice in a cage, stitched in place of a model without faces: the points of a cubic grid that are
/// inside the cage or near it, about 6,000. Squares of the grid connect them. Parts of the cage that are a
/// few cells apart are not connected. Depends only on the cage: a symmetric cage has a symmetric lattice.
/// Thread-safe after construction.
class Lattice {
public:
  /// The result does not depend on the number of threads.
  Lattice(const pose::Cage& cage, base::WorkerPool& pool);

  /// The points. A square is four triangles, two for each diagonal, so that no direction differs.
  mesh::Surface surface() const;

  using Term = SurfaceProxy::Term;
  /// Writes the terms of the value at p: products of quadratic B-splines of the coordinates, divided by their
  /// sum. The value and its first derivatives are continuous in the cage. Far from all points, there are no
  /// terms.
  void terms(const mesh::Point& p, std::vector<Term>& terms) const;

private:
  std::size_t keep(const mesh::TriangleTree& cage, base::WorkerPool& pool);
  std::size_t coordinate(std::size_t place, std::size_t axis) const {
    return place / step(axis) % size_[axis];
  }
  std::size_t step(std::size_t axis) const {
    return axis == 0 ? 1 : axis == 1 ? size_[0] : size_[0] * size_[1];
  }
  mesh::Point point(std::size_t place) const;

  mesh::Point low_{};  // the first point of the grid
  double cell_ = 0;
  std::array<std::size_t, 3> size_{};
  std::vector<std::uint32_t> number_;  // of each place in the grid, or none
};

/// Returns true if the model has more than most_solved_vertices vertices, and a triangle with an area.
bool needs_coarse_model(const mesh::Surface& model);

/// Returns true if stitching uses a CoarseModel: a proxy of a large model, or a lattice without faces.
bool stitches_coarse_model(const mesh::Surface& model);

/// The motion x -> rotation * x + shift.
struct RigidMotion {
  sym3::Mat3<double> rotation;
  Vec3 shift;
};

/// The clusters of a SurfaceProxy, at the means of their members, or the points of a Lattice. Interpolates
/// motions of clusters at the model's vertices; in a model with faces, vertices without triangles do not
/// move. Thread-safe.
class CoarseModel {
public:
  struct Term {
    std::uint32_t cluster;
    float factor;
  };

  /// Throws base::Error if the model has no triangles with an area. Throws base::Cancelled.
  explicit CoarseModel(const mesh::Surface& model, base::WorkerPool& pool, base::Progress* progress = nullptr)
      : CoarseModel(SurfaceProxy(model, pool, progress), model.positions.size(), pool) {}
  CoarseModel(const SurfaceProxy& proxy, std::size_t vertices, base::WorkerPool& pool);
  /// The clusters are the points of the lattice. A member is nearest to its point. Values are interpolated by
  /// B-splines or, far from the lattice, are those of the nearest point.
  CoarseModel(const Lattice& lattice, std::span<const mesh::Point> positions, base::WorkerPool& pool);

  const mesh::Surface& surface() const { return surface_; }
  const mesh::Adjacency& members() const { return members_; }
  /// A value at a vertex is the sum of factor * (value at the cluster).
  std::span<const Term> terms(std::size_t vertex) const;
  /// Replaces clusters that have no triangle with an area: their vertices move with the nearest other
  /// cluster. Returns the number of changed terms. Not thread-safe.
  std::size_t adopt_clusters();
  /// Return the mean of each cluster's members; without members, no displacement. If the argument is empty or
  /// null, the result is too. A lattice has no mask.
  std::vector<Vec3> means(std::span<const Vec3> of_vertices, base::WorkerPool& pool) const;
  Mask means(const Mask& mask) const;
  /// Returns the positions of the clusters if the model at `rest` has this shape.
  std::vector<Vec3> shape_of(std::span<const Vec3> shape, std::span<const Vec3> rest,
                             base::WorkerPool& pool) const;
  /// Adds the displacements of clusters, `moves`, to the positions of all vertices. The model's mask scales
  /// those of a lattice. Other clusters have the means of the mask.
  void move(std::span<const Vec3> moves, const Mask& mask, std::span<Vec3> positions,
            base::WorkerPool& pool) const;
  /// Returns the mean of the clusters' motions at a vertex. The mean of rotations is not orthogonal.
  RigidMotion blended(std::span<const RigidMotion> motions, std::size_t vertex) const;
  /// Returns the sum of the clusters' displacements at a vertex.
  Vec3 blended(std::span<const Vec3> moves, std::size_t vertex) const;

  /// True if the clusters are the points of a lattice. Then blended positions are those of these points, not
  /// means.
  bool is_lattice() const { return is_lattice_; }

private:
  template <class Find>
  void find_terms(std::size_t vertices, base::WorkerPool& pool, const Find& find);
  struct Block {
    std::vector<std::uint32_t> starts;  // start of the terms of each vertex, and the end
    std::vector<Term> terms;
  };

  mesh::Surface surface_;
  mesh::Adjacency members_;
  std::vector<Block> blocks_;
  bool is_lattice_ = false;
};

/// Makes the coarse model that is stitched, see stitches_coarse_model().
CoarseModel coarse_model_of(const mesh::Surface& model, const pose::Cage& cage, base::WorkerPool& pool,
                            base::Progress* progress = nullptr);

}  // namespace viete::weights
