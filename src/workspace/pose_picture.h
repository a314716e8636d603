// Small pictures of models and poses: flat shapes, sorted so that they can be drawn without a depth buffer.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "document/document.h"
#include "mesh/surface.h"

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

}  // namespace viete::workspace
