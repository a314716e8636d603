// A coarse copy of a large model, for weights along the surface, ARAP and shapes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/surface.h"
#include "pose/cage.h"
#include "pose/deformer.h"
#include "weights/surface_weights.h"

namespace viete::weights {

/// A coarser surface whose vertices are clusters of neighbouring vertices of a model.
///
/// A cluster is a connected piece of the surface in one cell of a grid. Therefore, a cluster never contains
/// vertices of two layers or parts. If a triangle has corners in three clusters, it becomes a triangle of the
/// proxy. A cell is halved (at most five times) if its cluster
///   - is in no triangle of the proxy,
///   - contains several vertices that handles own (see OwnedVertices), or
///   - touches a cluster with which it has no common triangle (in a tube thinner than a cell).
/// A cluster's position is the mean of its members: its vertices or, if some of them are on open edges, its
/// vertices on open edges. If a handle owns a vertex of the cluster, the cluster is at this vertex.
/// Without a cage, all clusters are at the means, and vertices without triangles have no cluster.
///
/// Many parts that are smaller than a few cells, such as leaves or hair cards, do not form such clusters. A
/// cluster then gathers all their vertices in a cell, and triangles join it to the nearest clusters.
///
/// Values at clusters are interpolated at the model's vertices by moving least squares: a quadratic
/// polynomial in the tangent plane of the vertex is fitted to nearby clusters. At vertices of gathered parts,
/// it is a linear polynomial in space. The result is smooth.
class SurfaceProxy {
public:
  /// Makes at most about `target` clusters. `cage` may be null. The model must outlive the proxy. Throws
  /// base::Error if the model has no triangles with an area. Throws base::Cancelled.
  SurfaceProxy(const mesh::Surface& model, const pose::Cage* cage, pose::Elements elements,
               std::size_t target, base::WorkerPool& pool, base::Progress* progress = nullptr,
               std::size_t most_gathered = mesh::none);
  /// Makes the usual number of clusters, without a cage. Makes none if more than `most_gathered` vertices
  /// would be gathered.
  SurfaceProxy(const mesh::Surface& model, base::WorkerPool& pool, base::Progress* progress,
               std::size_t most_gathered = mesh::none)
      : SurfaceProxy(model, nullptr, pose::Elements::face, proxy_vertices, pool, progress, most_gathered) {}

  /// Clusters and the triangles between them.
  const mesh::Surface& surface() const { return surface_; }
  /// The members of each cluster.
  const mesh::Adjacency& members() const { return members_; }
  bool has_cluster(std::uint32_t vertex) const { return of_vertex_[vertex] != mesh::none; }
  /// Number of vertices in clusters that gather small parts.
  std::size_t gathered() const { return gathered_; }

  struct Term {
    std::uint32_t cluster;
    double factor;
  };
  /// Writes the terms of the interpolated value at a vertex: the value is the sum of factor * (value at the
  /// cluster). The factors sum to 1 up to rounding. The vertex must have a cluster. Thread-safe.
  void terms(std::uint32_t vertex, std::vector<Term>& terms) const;

private:
  void cluster(std::size_t target, std::vector<bool> small, const std::vector<std::uint32_t>& place,
               std::span<const std::uint32_t> apart, base::Progress* progress);
  void place_clusters();
  void find_neighbours();
  void move_to(std::span<const std::uint32_t> owned);
  void adopt_loose_vertices();
  void fit_in_space(const mesh::Point& p, double radius, std::vector<Term>& terms) const;

  const mesh::Surface& model_;
  std::vector<mesh::Triangle> triangles_;  // the model's triangles, welded; empty after construction
  std::vector<std::uint32_t> of_vertex_;   // cluster of each vertex
  mesh::Adjacency members_;
  mesh::Surface surface_;
  std::uint32_t first_gathered_ = 0;  // clusters from here on gather small parts
  double cell_ = 0;                   // size of their cells
  std::size_t gathered_ = 0;
  std::vector<Vec3> normals_;  // one per cluster, unit length or 0
  std::vector<double> radii_;  // radius of influence per cluster
  std::vector<std::uint32_t> nearby_,
      starts_;  // for each cluster: itself, then all clusters within four rings
};

/// Weights along the surface of a large model, stored per cluster of its proxy. The weights of a cluster are
/// at least 0 and sum to 1. A vertex's weights are interpolated, so they sum to 1 and may be slightly
/// negative.
class ProxyWeights {
public:
  /// Solves on about `clusters` clusters. Errors: see SurfaceSystem.
  ProxyWeights(const mesh::Surface& model, const pose::Cage& cage, const pose::Weighting& weighting,
               base::WorkerPool& pool, base::Progress* progress, std::size_t clusters = proxy_vertices);

  /// Writes a vertex's weights. row.size() is the number of handles. Thread-safe.
  void row(std::uint32_t vertex, std::span<double> row) const;

  const SurfaceProxy& proxy() const { return proxy_; }
  std::span<const float> of_cluster(std::size_t cluster) const {
    return std::span(weights_).subspan(cluster * handles_, handles_);
  }

private:
  SurfaceProxy proxy_;
  std::size_t handles_;
  std::vector<float> weights_;  // [cluster][handle]
};

}  // namespace viete::weights
