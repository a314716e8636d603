// A small scene as flat shapes, sorted so that it can be drawn without a depth buffer.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "mesh/surface.h"
#include "sym3/rotation.h"

namespace viete::scene {

/// The content of a shape, which determines its colour.
enum class Ink {
  model,   ///< a face of the model; tone: brightness
  lit,     ///< the same without an outline
  weight,  ///< a face of the model; tones: weights, 0 to 1
  behind,  ///< a cage line that the model may cover
  cage,    ///< a cage line in front of the model
  marked   ///< an outline of a polygon
};

/// An area is convex and clockwise on screen; a line connects consecutive points.
struct PictureShape {
  Ink ink;
  std::vector<glm::vec2> points{};  ///< logical pixels, y down
  std::vector<float> tones{};       ///< one for a face of the model, one per point for weights
  std::vector<mesh::Triangle>
      triangles{};  ///< triangulation by point index, if a fan about the last point does not work

  friend bool operator==(const PictureShape&, const PictureShape&) = default;
};

/// View rotation in degrees: about the up axis, then about the right axis.
struct PictureAngles {
  double yaw = 0, pitch = 0;
};

/// An orthographic view along -z.
class PictureView {
public:
  /// Points that the view is fitted to.
  struct Frame {
    std::span<const mesh::Point> points;
    glm::vec2 size;  ///< picture size
    float margin;    ///< empty border around the points
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

/// Front-facing polygons, farthest first.
std::vector<std::size_t> facing(const PictureView& view, const mesh::Surface& surface,
                                std::span<const mesh::Point> at);
/// One polygon as an area.
PictureShape area(const PictureView& view, Ink ink, const mesh::Surface& surface, std::size_t polygon,
                  std::span<const mesh::Point> at);
/// One polygon as an outline.
PictureShape outline(const PictureView& view, const mesh::Surface& surface, std::size_t polygon,
                     std::span<const mesh::Point> at);

/// All front-facing polygons of the model, lit.
std::vector<PictureShape> lit_model(const PictureView& view, const mesh::Surface& model,
                                    std::span<const mesh::Point> at);
/// The edges of front-facing polygons (Ink::cage), or the others (Ink::behind).
std::vector<PictureShape> cage_lines(const PictureView& view, const deform::Cage& cage,
                                     std::span<const mesh::Point> at, Ink ink);

}  // namespace viete::scene
