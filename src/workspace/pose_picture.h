// Thumbnails of poses. If a pose has a shape of the model, the thumbnail shows the model, otherwise the cage.
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

/// The size of a thumbnail in logical pixels.
inline constexpr glm::vec2 pose_picture_size{56, 42};

/// The posed cage, scaled so that the cage at rest fits too. Empty for a cage with very many faces.
std::vector<PictureShape> pose_picture(const deform::Cage& cage, const deform::Pose& pose,
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
  std::shared_ptr<const deform::Cage> cage_;
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
