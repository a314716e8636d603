// Measures the strain of a deformed surface at each vertex.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::analysis {

/// The shape at rest of a triangle that has area, in coordinates of its plane. The side from corner 0 to
/// corner 1 is the vector (length, 0). The side from corner 0 to corner 2 is the vector (along, across).
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

/// The singular values of a triangle's map: the largest and the smallest ratio of posed to rest length.
struct Stretches {
  double larger, smaller;
};
Stretches stretches(const PlaneMap& map);

/// Compares deformed surfaces with a surface at rest. The value at a vertex is the mean over the adjacent
/// triangles that have area at rest, weighted by this area. If a vertex has no such triangle, its value is 0.
/// A measurement takes one to two milliseconds for 100,000 triangles. The number of threads does not change
/// the results. Thread-safe.
class Strain {
public:
  explicit Strain(const mesh::Surface& rest);

  const std::vector<mesh::Point>& rest() const { return rest_; }
  double diagonal() const { return diagonal_; }

  /// Returns at each vertex the mean of the function `of` for the stretches of the adjacent triangles.
  std::vector<double> means(std::span<const mesh::Point> deformed, double (*of)(const Stretches&),
                            base::WorkerPool& pool) const;
  /// Returns for each vertex the angle (0 to 180 degrees) of the rotation nearest to the mean map of the
  /// adjacent triangles. Each triangle's map also takes its normal at rest to its deformed normal.
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
