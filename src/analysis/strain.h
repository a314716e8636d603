// Measures the strain of a deformed surface at each vertex.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::analysis {

/// A triangle with an area. In axes of its plane, the sides at rest are (length, 0) and (along, across).
struct FlatFace {
  mesh::Triangle corners;
  double length, along, across;

  double area() const { return length * across / 2; }
};

/// Nullopt if the triangle has no area.
std::optional<FlatFace> flat_face(std::span<const mesh::Point> rest, const mesh::Triangle& triangle);

/// The map of a deformed triangle, from its plane at rest to space: the images of the axes of the plane.
struct PlaneMap {
  mesh::Vec3 x, y;
};
PlaneMap plane_map(const FlatFace& face, std::span<const mesh::Point> positions);

/// The singular values of the map: the lengths of the most and the least stretched unit vectors.
struct Stretches {
  double larger, smaller;
};
Stretches stretches(const PlaneMap& map);

/// Compares deformed surfaces with a surface at rest. The value at a vertex is the mean over the adjacent
/// triangles, weighted by their area at rest; 0 if they have no area. Takes one to two milliseconds for
/// 100,000 triangles. The number of threads does not change the results. Thread-safe.
class Strain {
public:
  explicit Strain(const mesh::Surface& rest);

  const std::vector<mesh::Point>& rest() const { return rest_; }
  double diagonal() const { return diagonal_; }

  /// The mean of a function of the stretches of triangles, at each vertex.
  std::vector<double> means(std::span<const mesh::Point> deformed, double (*of)(const Stretches&),
                            base::WorkerPool& pool) const;
  /// The angle in degrees, 0 to 180, of the rotation that is nearest to the mean map of the adjacent
  /// triangles. These maps also map the normal at rest to the deformed normal.
  std::vector<double> turns(std::span<const mesh::Point> deformed, base::WorkerPool& pool) const;

  /// The offset from `from` to `to` along the area-weighted normals of `from`, in the file's units.
  std::vector<double> along_normals(std::span<const mesh::Point> from, std::span<const mesh::Point> to,
                                    base::WorkerPool& pool) const;

private:
  mesh::Vec3 normal(std::span<const mesh::Point> deformed, std::size_t vertex) const;

  std::vector<mesh::Point> rest_;
  std::vector<FlatFace> faces_;  // with area
  mesh::Adjacency around_;       // the faces around each vertex
  double diagonal_ = 0;
};

}  // namespace viete::analysis
