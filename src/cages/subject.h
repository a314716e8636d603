// The model in the form used by cage making: scaled to unit diagonal, with its plane of symmetry.
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

/// Points p with dot(normal, p) = offset; normal is a unit vector.
struct Plane {
  mesh::Vec3 normal{1, 0, 0};
  double offset = 0;

  friend bool operator==(const Plane&, const Plane&) = default;
};

/// The half and its mirror image, joined at x = 0. Vertices of the half keep their numbers.
Shell whole(const Shell& half);

/// The best plane of symmetry, if the mirrored model stays within 2 % of its diagonal: perpendicular to a
/// coordinate axis or an axis of inertia, with adjusted position. Tests the centres of a few hundred
/// triangles. progress may be null; throws base::Cancelled.
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

/// A frame along the file's axes; a mirror becomes the plane x = 0. The model must have an extent.
Frame frame_of(const mesh::Surface& model, const std::optional<Plane>& mirror);
/// A frame along the axes of inertia of the triangles, or of the points if these have no area.
Frame own_frame(const mesh::Surface& model);

/// The model in a frame. A point set becomes triangles without area.
struct FramedModel {
  std::vector<Point> positions;
  std::vector<mesh::Triangle> triangles;
  mesh::Bounds box{};  ///< box of used vertices
  bool closed = false;
};

FramedModel model_in(const Frame& frame, const mesh::Surface& surface);
/// Leaves `closed` unset, which takes longest to compute.
FramedModel shape_in(const Frame& frame, const mesh::Surface& surface);

/// Data that depend on the model and mirror only; computed once. Thread-safe after construction.
struct Subject {
  /// The surface must have an extent. progress may be null; throws base::Cancelled.
  Subject(const mesh::Surface& surface, const std::optional<Plane>& mirror, base::Progress* progress);

  std::optional<Plane> mirror;
  Frame frame;
  FramedModel model;  ///< with a mirror, its box is symmetric
  mesh::TriangleTree tree;
};

}  // namespace viete::cages
