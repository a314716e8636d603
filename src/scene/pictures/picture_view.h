// A small scene as flat shapes: who draws them needs no depth.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "mesh/surface.h"
#include "sym3/rotation.h"

namespace viete::scene {

/// What a shape shows, by which it has its colour.
enum class Ink {
  model,   ///< an area of it; its tone says how light
  lit,     ///< the same without a line around it
  weight,  ///< an area of it; tones are weights, 0 to 1
  behind,  ///< a line of the cage that the model may hide
  cage,    ///< a line of the cage before the model
  marked   ///< a line around a polygon
};

/// An area is convex and clockwise on screen; a line goes from each point to the next one.
struct PictureShape {
  Ink ink;
  std::vector<glm::vec2> points{};  ///< logical pixels, y down
  std::vector<float> tones{};       ///< one for a part of the model, one a point for weights
  std::vector<mesh::Triangle>
      triangles{};  ///< of points, of a part of the model that is no fan about the last one

  friend bool operator==(const PictureShape&, const PictureShape&) = default;
};

/// Degrees that a scene is turned by to be seen: about what points up, then about what points right.
struct PictureAngles {
  double yaw = 0, pitch = 0;
};

/// Looks along -z, without perspective.
class PictureView {
public:
  /// Some points, and where they end in the picture.
  struct Frame {
    std::span<const mesh::Point> points;
    glm::vec2 size;  ///< of the picture
    float margin;    ///< around the points
  };
  PictureView(const PictureAngles& angles, const Frame& frame);

  glm::vec2 at(const mesh::Point& p) const;
  /// The way to the right, up, and to whoever looks.
  mesh::Vec3 seen(const mesh::Point& p) const;

private:
  sym3::Mat3<double> turn_;
  mesh::Point middle_{0, 0, 0};
  glm::vec2 size_;
  double scale_ = 1;
};

/// How light a face with that normal, as it is seen, is.
float lightness(const mesh::Vec3& normal);

/// The polygons that face the viewer, the farthest first.
std::vector<std::size_t> facing(const PictureView& view, const mesh::Surface& surface,
                                std::span<const mesh::Point> at);
/// One of them as an area.
PictureShape area(const PictureView& view, Ink ink, const mesh::Surface& surface, std::size_t polygon,
                  std::span<const mesh::Point> at);
/// The same as a line around it.
PictureShape outline(const PictureView& view, const mesh::Surface& surface, std::size_t polygon,
                     std::span<const mesh::Point> at);

/// All of the model that faces the viewer, lit.
std::vector<PictureShape> lit_model(const PictureView& view, const mesh::Surface& model,
                                    std::span<const mesh::Point> at);
/// The edges of the faces that face the viewer (Ink::cage), or the others (Ink::behind).
std::vector<PictureShape> cage_lines(const PictureView& view, const deform::Cage& cage,
                                     std::span<const mesh::Point> at, Ink ink);

}  // namespace viete::scene
