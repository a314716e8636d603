// A model as cages are made around it: its frame of unit diagonal, and its plane of symmetry.
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

/// The half and its image, joined where x is 0. Vertices of the half keep their numbers.
Shell whole(const Shell& half);

/// The plane about which the model is most nearly symmetric, if its image is nowhere farther from it than 2 %
/// of its diagonal: across an axis of its coordinates or of its inertia, moved to fit. Told by a few hundred
/// of its triangles' middles. progress may be null; throws base::Cancelled.
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

/// What does not depend on the wish but for the mirror: made once, asked by many. Thread-safe once made.
struct Subject {
  /// The surface has an extent. progress may be null; throws base::Cancelled.
  Subject(const mesh::Surface& surface, const std::optional<Plane>& mirror, base::Progress* progress);

  std::optional<Plane> mirror;
  Frame frame;
  FramedModel model;  ///< with a mirror, its box is as wide on both sides
  mesh::TriangleTree tree;
};

}  // namespace viete::cages
