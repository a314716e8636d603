// Thumbnails of poses: the model's shape if the pose has one, otherwise the cage.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <vector>

#include "document/document.h"
#include "document/up_axis.h"
#include "mesh/surface.h"
#include "workspace/picture_view.h"

namespace viete::workspace {

/// Logical pixels.
inline constexpr glm::vec2 pose_picture_size{56, 42};

/// All at the same scale for comparison: that of the cage at rest, or of the pose if it is larger. Empty for
/// a cage with very many faces.
std::vector<PictureShape> pose_picture(const deform::Cage& cage, const deform::Pose& pose,
                                       document::UpAxis up);

/// Creates each picture on first use and caches it as long as the pose is in use elsewhere.
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
  std::shared_ptr<const deform::Cage> cage_;
  std::shared_ptr<const mesh::Surface> model_;
  document::UpAxis up_ = document::UpAxis::y;
  std::map<const document::WholePose*, Picture> pictures_;
};

/// At the scale of the model at rest, or of the shape if it is larger. Empty without triangles.
std::vector<PictureShape> shape_picture(const mesh::Surface& model, std::span<const mesh::Point> shape,
                                        document::UpAxis up, glm::vec2 size);

/// Rotated to the view's orientation.
std::vector<mesh::Point> upright(std::span<const mesh::Point> points, document::UpAxis up);

}  // namespace viete::workspace
