// Conversion between meshes of the public header and internal surfaces, with checks.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "library/deform.h"
#include "mesh/surface.h"

namespace viete::library {

std::vector<mesh::Point> inside(std::span<const Point3> points);
std::vector<Point3> outside(std::span<const mesh::Point> points);

/// Throws base::Error for `what` ("the model") on invalid indices, faces of fewer than three corners, and
/// coordinates that are not finite or beyond largest_coordinate.
mesh::Surface surface_of(const Mesh& mesh, const char* what);
/// Limit of coordinates of deformable surfaces, as in `viete deform`.
inline constexpr double most_deformable = 1e60;
/// Throws base::Error unless the extent is `least` (0 for poses and shapes) to most_deformable, or a single
/// point, and all coordinates are within most_deformable.
void check_deformable(std::span<const mesh::Point> points, double least, const char* what);
mesh::Surface deformable_surface_of(const Mesh& mesh, const char* what);
Mesh mesh_of(const mesh::Surface& surface);

/// Groups three numbers per vertex into points. Throws base::Error as above.
std::vector<mesh::Point> points_of(std::span<const double> numbers, std::size_t vertices, const char* what);
void check_points(std::span<const mesh::Point> points, std::size_t vertices, const char* what);
/// Checks results. Throws base::Error with `advice`.
void check_finite(std::span<const mesh::Point> points, const char* what, const char* advice);

}  // namespace viete::library
