// Strain of a deformation at each vertex of a surface.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::analysis {

/// A triangle with area; its rest sides u = (length, 0) and v = (along, across) in axes of its plane.
struct FlatFace {
  mesh::Triangle corners;
  double length, along, across;

  double area() const { return length * across / 2; }
};

/// Empty if the triangle has no area.
std::optional<FlatFace> flat_face(std::span<const mesh::Point> rest, const mesh::Triangle& triangle);

/// The deformed axes of the plane: columns of the map from the plane to space.
struct PlaneMap {
  mesh::Vec3 x, y;
};
PlaneMap plane_map(const FlatFace& face, std::span<const mesh::Point> positions);

/// Singular values of the map: lengths of the most and the least stretched unit vectors.
struct Stretches {
  double larger, smaller;
};
Stretches stretches(const PlaneMap& map);

/// A rest surface prepared for comparison with its deformations. Vertex values are means over the adjacent
/// triangles, weighted by rest area; 0 without area. One to two milliseconds for 100,000 triangles. Same bits
/// for any number of threads; thread-safe.
class Strain {
public:
  explicit Strain(const mesh::Surface& rest);

  const std::vector<mesh::Point>& rest() const { return rest_; }
  /// The diagonal of the rest model.
  double diagonal() const { return diagonal_; }

  /// Vertex means of a function of triangle stretches.
  std::vector<double> means(std::span<const mesh::Point> deformed, double (*of)(const Stretches&),
                            base::WorkerPool& pool) const;
  /// Rotation angles in degrees, 0 to 180, of the rotations nearest to the mean maps of the adjacent
  /// triangles. A map takes the rest normal to the deformed normal.
  std::vector<double> turns(std::span<const mesh::Point> deformed, base::WorkerPool& pool) const;

  /// Offset of `to` from `from` along the area-weighted normals of `from`, in the file's units.
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
