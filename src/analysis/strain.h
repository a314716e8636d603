// Measures the strain of a deformed surface at each vertex.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::analysis {

/// A triangle with an area. In its plane, two sides at rest are the vectors (length, 0) and (along, across).
struct FlatFace {
  mesh::Triangle corners;
  double length, along, across;

  double area() const { return length * across / 2; }
};

/// Returns nullopt if the triangle has no area.
std::optional<FlatFace> flat_face(std::span<const mesh::Point> rest, const mesh::Triangle& triangle);

/// The map of a triangle from its rest plane to space. x and y are the images of the plane's basis vectors.
struct PlaneMap {
  mesh::Vec3 x, y;
};
PlaneMap plane_map(const FlatFace& face, std::span<const mesh::Point> positions);

/// The singular values of a triangle's map: the lengths of the most and the least stretched unit vectors.
struct Stretches {
  double larger, smaller;
};
Stretches stretches(const PlaneMap& map);

/// Compares deformed surfaces with a surface at rest. The value at a vertex is the mean over the adjacent
/// triangles, weighted by area at rest. If these triangles have no area, the value is 0. Takes one to two
/// milliseconds for 100,000 triangles. The number of threads does not change the results. Thread-safe.
class Strain {
public:
  explicit Strain(const mesh::Surface& rest);

  const std::vector<mesh::Point>& rest() const { return rest_; }
  double diagonal() const { return diagonal_; }

  /// Returns the mean of a function of the triangles' stretches at each vertex.
  std::vector<double> means(std::span<const mesh::Point> deformed, double (*of)(const Stretches&),
                            base::WorkerPool& pool) const;
  /// Returns for each vertex the angle (0 to 180 degrees) of the rotation nearest to the mean map of the
  /// adjacent triangles. These maps also map the normal at rest to the deformed normal.
  std::vector<double> turns(std::span<const mesh::Point> deformed, base::WorkerPool& pool) const;

  /// Returns the offsets from `from` to `to` along the area-weighted normals of `from`, in the file's units.
  std::vector<double> along_normals(std::span<const mesh::Point> from, std::span<const mesh::Point> to,
                                    base::WorkerPool& pool) const;

private:
  mesh::Vec3 normal(std::span<const mesh::Point> deformed, std::size_t vertex) const;

  std::vector<mesh::Point> rest_;
  std::vector<FlatFace> faces_;  // faces with area
  mesh::Adjacency around_;       // the faces around each vertex
  double diagonal_ = 0;
};

}  // namespace viete::analysis
