// Strain of a deformation at each vertex of a surface, and distances between facing parts.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::lab {

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

inline constexpr std::uint32_t no_partner = ~0u;

/// For each vertex the nearest vertex within `distance` in front of it that faces back, with free space
/// between; no_partner if there is none. Normals must be unit vectors. About 50 ms for 50,000 vertices and a
/// distance of 3 % of their diagonal.
std::vector<std::uint32_t> facing_vertices(std::span<const mesh::Point> positions,
                                           std::span<const mesh::Vec3> normals, double distance);

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

  /// Unit directions of the largest and the smallest stretch at a deformed vertex, with their factors.
  struct Direction {
    mesh::Vec3 most, least, normal;
    double larger, smaller;
  };
  /// From the mean log stretch of the triangles, projected onto the tangent plane.
  Direction direction(std::span<const mesh::Point> deformed, std::size_t vertex) const;

  /// Distance of each vertex from the part that it faced at rest, relative to the rest distance; 1 without
  /// such a part within 3 % of the diagonal. The first call finds the facing parts.
  std::vector<double> openings(std::span<const mesh::Point> deformed) const;

  /// Vertices spread over the rest surface, about 50 along the diagonal.
  const std::vector<std::uint32_t>& spread() const { return spread_; }
  /// The distance between these vertices.
  double spacing() const { return diagonal_ / spread_along; }

private:
  static constexpr double spread_along = 50;

  void choose_spread();
  mesh::Vec3 normal(std::span<const mesh::Point> deformed, std::size_t vertex) const;

  std::vector<mesh::Point> rest_;
  std::vector<FlatFace> faces_;  // with area
  mesh::Adjacency around_;       // the faces around each vertex
  double diagonal_ = 0;
  std::vector<std::uint32_t> spread_;
  mutable std::once_flag faced_once_;
  mutable std::vector<std::uint32_t> faced_;  // see facing_vertices(); filled in by openings()
};

}  // namespace viete::lab
