// The input for making a cage: the model with a diagonal of 1, and its plane of symmetry.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "cages/clearance.h"
#include "cages/extraction.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"
#include "mesh/vector.h"

namespace viete::cages {

/// A plane: the points p with dot(normal, p) = offset. The normal has length 1.
struct Plane {
  mesh::Vec3 normal{1, 0, 0};
  double offset = 0;

  friend bool operator==(const Plane&, const Plane&) = default;
};

/// Joins a half shell and its mirror image at x = 0. The vertices of the half keep their indices.
Shell whole(const Shell& half);

/// Returns the best plane of symmetry. Mirrored sample points must be within 2 % of the diagonal from the
/// model. If no plane is that good, returns nullopt. `progress` may be null. Throws base::Cancelled.
std::optional<Plane> symmetry_plane(const mesh::Surface& model, base::Progress* progress);

struct Frame {
  Point center{};
  double scale = 1;
  std::array<Vec3, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< orthonormal, right-handed

  Point into(const Point& p) const {
    const Vec3 d = scale * (p - center);
    return {mesh::dot(axes[0], d), mesh::dot(axes[1], d), mesh::dot(axes[2], d)};
  }
  Point out_of(const Point& p) const {
    return center + (1 / scale) * (p[0] * axes[0] + p[1] * axes[1] + p[2] * axes[2]);
  }
};

/// Returns the bounding box of the vertices that triangles use. If there are no triangles, uses all vertices.
mesh::Bounds extent_of(const mesh::Surface& surface);

/// Returns a frame in which the mirror is the plane x = 0. If there is no mirror, the frame has the file's
/// axes. The model must have at least two different points.
Frame frame_of(const mesh::Surface& model, const std::optional<Plane>& mirror);
/// Returns a frame along the model's axes of inertia. If the triangles have no area, uses the points.
Frame own_frame(const mesh::Surface& model);

/// The model in a frame. If the model has no triangles, each point becomes a triangle without area.
struct FramedModel {
  std::vector<Point> positions;
  std::vector<mesh::Triangle> triangles;
  mesh::Bounds box{};
  bool closed = false;
};

FramedModel model_in(const Frame& frame, const mesh::Surface& surface);

/// The data for all cages with one mirror plane. Thread-safe after construction.
struct Subject {
  /// The surface must have at least two different points. `progress` may be null. Throws base::Cancelled.
  Subject(const mesh::Surface& surface, const std::optional<Plane>& mirror, base::Progress* progress);

  std::optional<Plane> mirror;
  Frame frame;
  FramedModel model;  ///< if there is a mirror, the box is symmetric about x = 0
  mesh::TriangleTree tree;
};

}  // namespace viete::cages
