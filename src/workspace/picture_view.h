// A small picture of a model as flat shapes, sorted so that it can be drawn without a depth buffer.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "mesh/surface.h"
#include "sym3/rotation.h"

namespace viete::workspace {

/// A face of the model, convex and clockwise on screen.
struct PictureShape {
  bool outlined = true;
  std::vector<glm::vec2> points{};  ///< logical pixels, y down
  float tone = 1;                   ///< brightness
  /// Triangulation by point index, if a fan about the last point does not work.
  std::vector<mesh::Triangle> triangles{};

  friend bool operator==(const PictureShape&, const PictureShape&) = default;
};

/// View rotation in degrees: about the up axis, then about the right axis.
struct PictureAngles {
  double yaw = 0, pitch = 0;
};

/// An orthographic view along -z.
class PictureView {
public:
  /// The points that must fit into the picture.
  struct Frame {
    std::span<const mesh::Point> points;
    glm::vec2 size;  ///< picture size
    float margin;    ///< width of the empty border
  };
  PictureView(const PictureAngles& angles, const Frame& frame);

  glm::vec2 at(const mesh::Point& p) const;
  /// Coordinates in the view: right, up, towards the viewer.
  mesh::Vec3 seen(const mesh::Point& p) const;

private:
  sym3::Mat3<double> turn_;
  mesh::Point middle_{0, 0, 0};
  glm::vec2 size_;
  double scale_ = 1;
};

/// The brightness of a face with this normal in view coordinates.
float lightness(const mesh::Vec3& normal);

/// The front-facing polygons of the model with their brightness, farthest first.
std::vector<PictureShape> lit_model(const PictureView& view, const mesh::Surface& model,
                                    std::span<const mesh::Point> at);

}  // namespace viete::workspace
