// Meshes of the public header as the rooms have them, checked.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "library/deform.h"
#include "mesh/surface.h"

namespace viete::library {

/// As the rooms have them, and back.
std::vector<mesh::Point> inside(std::span<const Point3> points);
std::vector<Point3> outside(std::span<const mesh::Point> points);

/// Throws base::Error that names `what` ("the model"): corners that are no vertices, faces of fewer than
/// three, places that are not finite or farther out than files may be.
mesh::Surface surface_of(const Mesh& mesh, const char* what);
/// The largest coordinate of anything that is deformed, as in `viete deform`.
inline constexpr double most_deformable = 1e60;
/// The same of what is deformed: `least` (of poses and shapes 0) to most_deformable across, or a point, and no
/// farther out.
void check_deformable(std::span<const mesh::Point> points, double least, const char* what);
mesh::Surface deformable_surface_of(const Mesh& mesh, const char* what);
Mesh mesh_of(const mesh::Surface& surface);

/// Places of so many vertices, three numbers each. Throws base::Error as above.
std::vector<mesh::Point> points_of(std::span<const double> numbers, std::size_t vertices, const char* what);
void check_points(std::span<const mesh::Point> points, std::size_t vertices, const char* what);
/// Of what was made. Throws base::Error with that advice.
void check_finite(std::span<const mesh::Point> points, const char* what, const char* advice);

}  // namespace viete::library
