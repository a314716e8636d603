// Where the nodes of a glTF scene put its meshes, and which of the file's vertices became which of the
// surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "mesh/formats/gltf_file.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// x' = M x + offset, M by columns.
struct AffineMap {
  std::array<Vec3, 3> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec3 offset{0, 0, 0};

  bool is_identity() const { return *this == AffineMap{}; }
  double determinant() const { return dot(columns[0], cross(columns[1], columns[2])); }
  Vec3 of_vector(const Vec3& v) const { return v[0] * columns[0] + v[1] * columns[1] + v[2] * columns[2]; }
  Vec3 of_point(const Point& p) const { return of_vector(p) + offset; }
  /// Of a plane's normal: by the cofactors, which keep its side, also in a mirror. Not of unit length.
  Vec3 of_normal(const Vec3& n) const;
  /// Nothing where it flattens space.
  std::optional<AffineMap> inverse() const;

  friend AffineMap operator*(const AffineMap& a, const AffineMap& b);
  friend bool operator==(const AffineMap&, const AffineMap&) = default;
};

/// A mesh as one node places it.
struct GltfPlacement {
  int node = 0, mesh = 0;
  AffineMap map;  ///< from the mesh into the scene
};

/// Those of the default scene, or of the first one, or of all nodes; each before its children. Throws
/// base::Error where nodes form anything but trees, or are not there.
std::vector<GltfPlacement> placements_of(const GltfFile& file);

/// Accessors of the differences that a morph target adds to its vertices; -1: none.
struct GltfTarget {
  int positions = -1, normals = -1, tangents = -1;
};

/// Vertices that primitives of one placement share: consecutive vertices of the file, as counted here.
struct GltfPiece {
  std::size_t placement = 0, first = 0, count = 0;
  int positions = -1, normals = -1, tangents = -1;         ///< accessors; -1: none
  std::shared_ptr<const std::vector<GltfTarget>> targets;  ///< of the first of these primitives
};

struct GltfMap {
  std::vector<GltfPlacement> placements;
  std::vector<GltfPiece> pieces;              ///< by first
  std::vector<std::uint32_t> surface_vertex;  ///< of each vertex of the file
  std::vector<std::uint32_t> corner_vertex;   ///< of each of Surface::corners, the vertex of the file
};

}  // namespace viete::mesh
