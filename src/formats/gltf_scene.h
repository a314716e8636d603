// Places meshes by the nodes of a glTF scene, and maps vertices of the file to vertices of the surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "formats/gltf_file.h"
#include "mesh/surface.h"

namespace viete::formats {

/// Maps a point x to M * x + offset. `columns` are the columns of the matrix M.
struct AffineMap {
  std::array<mesh::Vec3, 3> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  mesh::Vec3 offset{0, 0, 0};

  bool is_identity() const { return *this == AffineMap{}; }
  double determinant() const { return dot(columns[0], mesh::cross(columns[1], columns[2])); }
  mesh::Vec3 of_vector(const mesh::Vec3& v) const {
    return v[0] * columns[0] + v[1] * columns[1] + v[2] * columns[2];
  }
  mesh::Vec3 of_point(const mesh::Point& p) const { return of_vector(p) + offset; }
  /// Maps a plane's normal by the matrix of cofactors. Even if the map is a mirror, the normal stays on the
  /// same side of the plane. The result can have any length.
  mesh::Vec3 of_normal(const mesh::Vec3& n) const;
  /// Returns nullopt if the map is singular.
  std::optional<AffineMap> inverse() const;

  friend AffineMap operator*(const AffineMap& a, const AffineMap& b);
  friend bool operator==(const AffineMap&, const AffineMap&) = default;
};

/// A mesh placed by one node.
struct GltfPlacement {
  int node = 0, mesh = 0;
  AffineMap map;  ///< from mesh coordinates to scene coordinates
};

/// Returns the placements in the default scene; without a default, in the first scene; without scenes, of all
/// nodes. Parents come first. If the nodes do not form trees or an index is invalid, throws base::Error.
std::vector<GltfPlacement> placements_of(const GltfFile& file);

/// The accessors of a morph target's offsets. -1 means missing.
struct GltfTarget {
  int positions = -1, normals = -1, tangents = -1;
};

/// Consecutive vertices of the file that one or more primitives of a placement use.
struct GltfPiece {
  std::size_t placement = 0, first = 0, count = 0;
  int positions = -1, normals = -1, tangents = -1;         ///< accessors; -1 means missing
  std::shared_ptr<const std::vector<GltfTarget>> targets;  ///< targets of the first primitive of the piece
};

struct GltfMap {
  std::vector<GltfPlacement> placements;
  std::vector<GltfPiece> pieces;              ///< sorted by `first`
  std::vector<std::uint32_t> surface_vertex;  ///< for each vertex of the file, a vertex of the surface
  std::vector<std::uint32_t> corner_vertex;   ///< for each entry of Surface::corners, a vertex of the file
};

}  // namespace viete::formats
