#include "scene/pictures/pose_picture.h"

#include <algorithm>

namespace viete::scene {

namespace {

constexpr std::size_t most_faces = 3000;  // more would be neither legible nor quick

// As it stands in the view.
mesh::Point upright(const mesh::Point& p, UpAxis up) {
  return up == UpAxis::y ? p : mesh::Point{p[0], p[2], -p[1]};
}

std::vector<mesh::Point> upright(const std::vector<mesh::Point>& points, UpAxis up) {
  std::vector<mesh::Point> all;
  for (const mesh::Point& p : points) all.push_back(upright(p, up));
  return all;
}

}  // namespace

std::vector<PictureShape> pose_picture(const deform::Cage& cage, const deform::Pose& pose, UpAxis up) {
  if (cage.surface.polygon_count() > most_faces) return {};
  constexpr PictureAngles angles{-32, 18};
  const std::vector<mesh::Point> at = upright(pose.positions, up);
  std::vector<mesh::Point> framed = upright(cage.surface.positions, up);
  framed.insert(framed.end(), at.begin(), at.end());
  return lit_model(PictureView(angles, {framed, pose_picture_size, 3}), cage.surface, at);
}

const std::vector<PictureShape>& PosePictures::of(const std::shared_ptr<const deform::Cage>& cage,
                                                  const SharedPose& pose, UpAxis up) {
  if (cage != cage_ || up != up_) pictures_.clear();
  cage_ = cage;
  up_ = up;
  Picture& picture = pictures_[pose.get()];
  if (!picture.pose) picture = {pose, pose_picture(*cage, pose->cage, up)};
  return picture.shapes;
}

void PosePictures::tidy() {
  std::erase_if(pictures_, [](const auto& entry) { return entry.second.pose.use_count() == 1; });
}

}  // namespace viete::scene
