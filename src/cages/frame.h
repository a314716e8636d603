// Coordinates in which cages are made: the model's diagonal is 1, its middle at 0.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cages/clearance.h"
#include "cages/plane.h"
#include "mesh/surface.h"

namespace viete::cages {

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

/// Along the file's axes, or, with a mirror, with it in the plane x = 0. The model has an extent.
Frame frame_of(const mesh::Surface& model, const std::optional<Plane>& mirror);
/// Along the axes of inertia of the model's triangles, or of its points where these have no area.
Frame own_frame(const mesh::Surface& model);

/// The model in a frame; its points as triangles without area where it has no others.
struct FramedModel {
  std::vector<Point> positions;
  std::vector<mesh::Triangle> triangles;
  mesh::Bounds box{};  ///< of what triangles use
  bool closed = false;
};

FramedModel model_in(const Frame& frame, const mesh::Surface& surface);
/// The same, but whether it is closed is not asked, which takes longest.
FramedModel shape_in(const Frame& frame, const mesh::Surface& surface);

}  // namespace viete::cages
