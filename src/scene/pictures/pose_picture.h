// Small pictures of poses: the model's shape in each of them, or else the cage.
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

/// All on one scale, so that they can be compared: that of the cage at rest, or of the pose where it is
/// larger. Empty for a cage of very many faces.
std::vector<PictureShape> pose_picture(const deform::Cage& cage, const deform::Pose& pose, UpAxis up);

/// Each is made when it is first asked for, and kept as long as the pose is in use elsewhere.
class PosePictures {
public:
  const std::vector<PictureShape>& of(const Document& document, const SharedPose& pose, UpAxis up);
  /// Forgets those of poses that are gone.
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

/// On the scale of the model at rest, or of the shape where it is larger. Empty where it has no triangles.
std::vector<PictureShape> shape_picture(const mesh::Surface& model, std::span<const mesh::Point> shape,
                                        UpAxis up, glm::vec2 size);

/// As it stands in the view.
std::vector<mesh::Point> upright(std::span<const mesh::Point> points, UpAxis up);

}  // namespace viete::scene
