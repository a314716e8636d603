#include "scene/pictures/pose_picture.h"

#include <algorithm>

#include "scene/pictures/shape_picture.h"

namespace viete::scene {

namespace {

constexpr std::size_t most_faces = 3000;  // more would be neither legible nor quick

}  // namespace

std::vector<PictureShape> pose_picture(const deform::Cage& cage, const deform::Pose& pose, UpAxis up) {
  if (cage.surface.polygon_count() > most_faces) return {};
  constexpr PictureAngles angles{-32, 18};
  const std::vector<mesh::Point> at = upright(pose.positions, up);
  std::vector<mesh::Point> framed = upright(cage.surface.positions, up);
  framed.insert(framed.end(), at.begin(), at.end());
  return lit_model(PictureView(angles, {framed, pose_picture_size, 3}), cage.surface, at);
}

const std::vector<PictureShape>& PosePictures::of(const Document& document, const SharedPose& pose,
                                                  UpAxis up) {
  if (document.cage != cage_ || document.model.surface != model_ || up != up_) pictures_.clear();
  cage_ = document.cage;
  model_ = document.model.surface;
  up_ = up;
  Picture& picture = pictures_[pose.get()];
  if (picture.pose) return picture.shapes;
  picture.pose = pose;
  if (pose->shape) {
    picture.shapes = shape_picture(*model_, *pose->shape, up, pose_picture_size);
  } else if (cage_) {
    picture.shapes = pose_picture(*cage_, pose->cage, up);
  }
  return picture.shapes;
}

void PosePictures::tidy() {
  std::erase_if(pictures_, [](const auto& entry) { return entry.second.pose.use_count() == 1; });
}

}  // namespace viete::scene
