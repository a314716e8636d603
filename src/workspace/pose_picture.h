// Small pictures of models and poses: flat shapes, sorted so that they can be drawn without a depth buffer.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "document/document.h"
#include "mesh/surface.h"
#include "sym3/rotation.h"

namespace viete::workspace {

/// A face of the model or a row of pixels, clockwise on screen.
struct PictureShape {
  bool outlined = true;
  std::vector<glm::vec2> points{};  ///< logical pixels, y down
  float tone = 1;                   ///< brightness
  /// Triangles of point indices. If empty, the triangles are a fan about the last point.
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
  /// The points must fit into the picture.
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

/// The front-facing polygons of the model with their brightness, sorted from back to front.
std::vector<PictureShape> lit_model(const PictureView& view, const mesh::Surface& model,
                                    std::span<const mesh::Point> at);

/// The size of a thumbnail in logical pixels.
inline constexpr glm::vec2 pose_picture_size{56, 42};

/// The posed cage, scaled so that the cage at rest fits too. Empty for a cage with very many faces.
std::vector<PictureShape> pose_picture(const mesh::Surface& cage, std::span<const mesh::Point> posed,
                                       document::UpAxis up);

/// Caches the picture of each pose as long as the pose is in use elsewhere.
class PosePictures {
public:
  const std::vector<PictureShape>& of(const document::Document& document, const document::SharedPose& pose,
                                      document::UpAxis up);
  /// Removes pictures of poses that no longer exist.
  void tidy();

private:
  struct Picture {
    document::SharedPose pose;
    std::vector<PictureShape> shapes;
  };
  std::shared_ptr<const pose::Cage> cage_;
  std::shared_ptr<const mesh::Surface> model_;
  document::UpAxis up_ = document::UpAxis::y;
  std::map<const document::WholePose*, Picture> pictures_;
};

/// A shape of the model, scaled so that the model at rest fits too. Empty without triangles.
std::vector<PictureShape> shape_picture(const mesh::Surface& model, std::span<const mesh::Point> shape,
                                        document::UpAxis up, glm::vec2 size);

/// The points rotated so that Y is up.
std::vector<mesh::Point> upright(std::span<const mesh::Point> points, document::UpAxis up);

}  // namespace viete::workspace
