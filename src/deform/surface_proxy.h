// A coarse copy of a large model, on which weights along the surface are solved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/cage.h"
#include "deform/scheme.h"
#include "mesh/surface.h"

namespace viete::deform {

/// The vertices of a proxy, about.
inline constexpr std::size_t proxy_vertices = 40'000;
/// Models with more vertices solve their weights along the surface on a proxy: below, a proxy saves little
/// time.
inline constexpr std::size_t most_solved_vertices = 2 * proxy_vertices;

/// Clusters of neighbouring vertices of a model, as vertices of a coarser surface.
///
/// A cluster is a connected piece of the surface in one cell of a grid, so that layers and parts stay apart.
/// Where clusters meet without a common corner (a tube that is thinner than a cell) their cells are halved,
/// up to five times. A cluster's vertex is the mean of its members, on an open edge the mean of those on the
/// edge, and next to a handle of the cage the nearest vertex of the model. The triangles of the proxy are the
/// triangles of the model whose corners lie in three clusters.
///
/// Values at the proxy's vertices are carried to the model by moving least squares: around each vertex of the
/// model a quadratic polynomial in its tangent plane is fitted to the clusters nearby. This is smooth and
/// reproduces linear functions of the tangent plane.
class SurfaceProxy {
public:
  /// About `target` clusters. The model must outlive the proxy. Throws base::Error when the model has no
  /// triangles, and base::Cancelled.
  SurfaceProxy(const mesh::Surface& model, const Cage& cage, Elements elements, std::size_t target,
               base::WorkerPool& pool, base::Progress* progress = nullptr);

  /// Clusters and the triangles between them.
  const mesh::Surface& surface() const { return surface_; }

  /// The value at a vertex of the model is the sum of factor times the value at the cluster. Factors sum to 1
  /// up to rounding. Thread-safe.
  struct Term {
    std::uint32_t cluster;
    double factor;
  };
  void terms(std::uint32_t vertex, std::vector<Term>& terms) const;

private:
  void cluster(std::size_t target, const std::vector<std::uint32_t>& place, base::Progress* progress);
  void place_clusters();
  void find_neighbours();
  void move_to_handles(const Cage& cage, Elements elements, base::WorkerPool& pool);
  void adopt_loose_vertices();

  const mesh::Surface& model_;
  std::vector<mesh::Triangle> triangles_;  // of the model, welded
  std::vector<std::uint32_t> of_vertex_;   // the cluster of each vertex
  mesh::Surface surface_;
  std::vector<Vec3> normals_;                   // of the clusters, unit length or 0
  std::vector<double> radii_;                   // the reach of each cluster
  std::vector<std::uint32_t> nearby_, starts_;  // clusters within two rings, itself first
};

/// Weights along the surface of a large model: one row for each cluster of its proxy.
class ProxyWeights {
public:
  /// Solves for the weights on a proxy of about so many clusters; reports up to `done`. See SurfaceSystem for
  /// errors.
  ProxyWeights(const mesh::Surface& model, const Cage& cage, const Weighting& weighting,
               base::WorkerPool& pool, base::Progress* progress, double done,
               std::size_t clusters = proxy_vertices);

  /// The weights of a vertex of the model: not below 0, of sum 1. Thread-safe.
  void row(std::uint32_t vertex, std::span<double> row) const;

private:
  SurfaceProxy proxy_;
  std::size_t handles_;
  std::vector<float> weights_;  // [cluster][handle]
};

}  // namespace viete::deform
