// Strain of a deformation at each vertex of a surface, and surfaces close to each other.
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

/// A triangle with area, and its sides u = (length, 0) and v = (along, across) at rest, in axes of its plane.
struct FlatFace {
  mesh::Triangle corners;
  double length, along, across;

  double area() const { return length * across / 2; }
};

/// Nothing where the triangle has no area.
std::optional<FlatFace> flat_face(std::span<const mesh::Point> rest, const mesh::Triangle& triangle);

/// Where the axes of the plane have gone: columns of the map from the plane into space.
struct PlaneMap {
  mesh::Vec3 x, y;
};
PlaneMap plane_map(const FlatFace& face, std::span<const mesh::Point> positions);

/// Singular values of such a map: how long the most and the least stretched unit vector has become.
struct Stretches {
  double larger, smaller;
};
Stretches stretches(const PlaneMap& map);

inline constexpr std::uint32_t no_partner = ~0u;

/// Of each vertex the nearest one, at most so far away, that it sees before it, and that looks back: what
/// lies between the two is open. no_partner where there is none. Normals are of length 1. Some 50 ms for
/// 50,000 vertices and a distance of 3 % of their diagonal.
std::vector<std::uint32_t> facing_vertices(std::span<const mesh::Point> positions,
                                           std::span<const mesh::Vec3> normals, double distance);

/// A surface at rest, ready to be compared with itself deformed. Values at vertices are means over the
/// triangles around, by their areas at rest; 0 where none has area. A millisecond or two for 100,000
/// triangles. The same bits for any number of threads; const and thread-safe.
class Strain {
public:
  explicit Strain(const mesh::Surface& rest);

  const std::vector<mesh::Point>& rest() const { return rest_; }
  /// Of the model at rest.
  double diagonal() const { return diagonal_; }

  /// Means of a number that a triangle's stretches tell.
  std::vector<double> means(std::span<const mesh::Point> deformed, double (*of)(const Stretches&),
                            base::WorkerPool& pool) const;
  /// Angles, in degrees from 0 to 180, of the rotations nearest to the mean maps of the triangles around; a
  /// map takes the normal at rest to the normal.
  std::vector<double> turns(std::span<const mesh::Point> deformed, base::WorkerPool& pool) const;

  /// How far `to` is from `from` along the normals of `from`, which are means by area; in the file's units.
  std::vector<double> along_normals(std::span<const mesh::Point> from, std::span<const mesh::Point> to,
                                    base::WorkerPool& pool) const;

  /// The most stretched direction at a vertex, as it is deformed, of length 1, and by how much; the least.
  struct Direction {
    mesh::Vec3 most, least, normal;
    double larger, smaller;
  };
  /// From the mean of the logs of the triangles' stretches, projected to the plane across the normal.
  Direction direction(std::span<const mesh::Point> deformed, std::size_t vertex) const;

  /// How many times as far each vertex is from the part that it faced at rest, at most 3 % of the diagonal
  /// away; 1 where it faced none. Which that is, is found out by the first call.
  std::vector<double> openings(std::span<const mesh::Point> deformed) const;

  /// Vertices that are spread over the surface at rest, about 50 along the diagonal.
  const std::vector<std::uint32_t>& spread() const { return spread_; }
  /// How far apart these are.
  double spacing() const { return diagonal_ / spread_along; }

private:
  static constexpr double spread_along = 50;

  void choose_spread();
  mesh::Vec3 normal(std::span<const mesh::Point> deformed, std::size_t vertex) const;

  std::vector<mesh::Point> rest_;
  std::vector<FlatFace> faces_;  // that have area
  mesh::Adjacency around_;       // of vertices, of these
  double diagonal_ = 0;
  std::vector<std::uint32_t> spread_;
  mutable std::once_flag faced_once_;
  mutable std::vector<std::uint32_t> faced_;  // see facing_vertices(); what openings() has found out
};

}  // namespace viete::lab
