// A coarse copy of a large model for computing weights along the surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/cage.h"
#include "deform/scheme.h"
#include "deform/surface_weights.h"
#include "mesh/surface.h"

namespace viete::deform {

/// A coarser surface whose vertices are clusters of neighbouring vertices of a model.
///
/// A cluster is a connected piece of the surface in one cell of a grid, so layers and parts stay apart.
/// Cells whose clusters meet without a common corner (a tube thinner than a cell) are halved, up to five
/// times, and so are those that several handles own. A cluster's position is the mean of its members. On an
/// open edge it is the mean of the members on the edge, and a vertex that a handle owns replaces it. The
/// proxy's triangles are the model's triangles with corners in three clusters.
///
/// Values at clusters are interpolated at the model's vertices by moving least squares: a quadratic
/// polynomial in the tangent plane of the vertex is fitted to nearby clusters. The result is smooth and
/// reproduces linear functions on the tangent plane.
class SurfaceProxy {
public:
  /// About `target` clusters. The model must outlive the proxy. Throws base::Error when the model has no
  /// triangles, and base::Cancelled.
  SurfaceProxy(const mesh::Surface& model, const Cage& cage, Elements elements, std::size_t target,
               base::WorkerPool& pool, base::Progress* progress = nullptr);

  /// Clusters and the triangles between them.
  const mesh::Surface& surface() const { return surface_; }
  /// Clusters at vertices that handles own in the model, ascending.
  const std::vector<std::uint32_t>& owned() const { return owned_; }

  /// The interpolated value at a vertex is the sum of factor times value at cluster. Factors sum to 1 up to
  /// rounding. Thread-safe.
  struct Term {
    std::uint32_t cluster;
    double factor;
  };
  void terms(std::uint32_t vertex, std::vector<Term>& terms) const;

private:
  void cluster(std::size_t target, const std::vector<std::uint32_t>& place,
               std::span<const std::uint32_t> apart, base::Progress* progress);
  void place_clusters();
  void find_neighbours();
  void move_to(std::span<const std::uint32_t> owned);
  void adopt_loose_vertices();

  const mesh::Surface& model_;
  std::vector<mesh::Triangle> triangles_;  // the model's, welded
  std::vector<std::uint32_t> of_vertex_;   // cluster of each vertex
  mesh::Surface surface_;
  std::vector<std::uint32_t> owned_;
  std::vector<Vec3> normals_;                   // one per cluster, unit length or 0
  std::vector<double> radii_;                   // radius of influence per cluster
  std::vector<std::uint32_t> nearby_, starts_;  // clusters within four rings, itself first
};

/// Weights along the surface of a large model, stored per cluster of its proxy.
class ProxyWeights {
public:
  /// Solves on a proxy of about `clusters` clusters; reports progress up to `done`. Errors: see
  /// SurfaceSystem.
  ProxyWeights(const mesh::Surface& model, const Cage& cage, const Weighting& weighting,
               base::WorkerPool& pool, base::Progress* progress, double done,
               std::size_t clusters = proxy_vertices);

  /// Weights of a vertex of the model, at least 0, sum 1. row.size() == number of handles. Thread-safe.
  void row(std::uint32_t vertex, std::span<double> row) const;

  /// The same before normalisation.
  void interpolate(std::uint32_t vertex, std::span<float> row) const;

private:
  SurfaceProxy proxy_;
  std::size_t handles_;
  std::vector<float> weights_;  // [cluster][handle]
};

}  // namespace viete::deform
