// Matches the vertices of two surfaces by their faces.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// For each vertex of `wanted`, returns the vertex of `found`, or nullopt if the surfaces do not match. They
/// match in these cases:
/// - `keeps_order` is true, and the faces are equal in any order and with any first corners: equal indices.
/// - `found` has no faces, but as many vertices: equal indices.
/// - The faces are in the same order, and their corners define a one-to-one map of the vertices. Vertices
///   without faces are matched in the order of the file.
/// Faces are polygons. If the numbers of polygons differ, faces are triangles.
std::optional<std::vector<std::uint32_t>> vertex_order(const Surface& found, const Surface& wanted,
                                                       bool keeps_order);

/// If vertex_order() returns nullopt, describes the first difference. `of` names `wanted`: "the model".
std::string first_difference(const Surface& found, const Surface& wanted, const std::string& of);

}  // namespace viete::mesh
