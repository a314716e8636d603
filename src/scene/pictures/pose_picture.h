// Thumbnails of poses: the model's shape if the pose has one, otherwise the cage.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <vector>

#include "mesh/surface.h"
#include "scene/document/document.h"
#include "scene/document/up_axis.h"
#include "scene/pictures/picture_view.h"

namespace viete::scene {

/// Logical pixels.
inline constexpr glm::vec2 pose_picture_size{56, 42};

/// All at the same scale for comparison: that of the cage at rest, or of the pose if it is larger. Empty for
/// a cage with very many faces.
std::vector<PictureShape> pose_picture(const deform::Cage& cage, const deform::Pose& pose, UpAxis up);

/// Creates each picture on first use and caches it as long as the pose is in use elsewhere.
class PosePictures {
public:
  const std::vector<PictureShape>& of(const Document& document, const SharedPose& pose, UpAxis up);
  /// Removes pictures of poses that no longer exist.
  void tidy();

private:
  struct Picture {
    SharedPose pose;
    std::vector<PictureShape> shapes;
  };
  std::shared_ptr<const deform::Cage> cage_;
  std::shared_ptr<const mesh::Surface> model_;
  UpAxis up_ = UpAxis::y;
  std::map<const WholePose*, Picture> pictures_;
};

/// At the scale of the model at rest, or of the shape if it is larger. Empty without triangles.
std::vector<PictureShape> shape_picture(const mesh::Surface& model, std::span<const mesh::Point> shape,
                                        UpAxis up, glm::vec2 size);

/// Rotated to the view's orientation.
std::vector<mesh::Point> upright(std::span<const mesh::Point> points, UpAxis up);

}  // namespace viete::scene
