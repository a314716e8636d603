// A cube in an animated cage.
#pragma once

#include <cmath>

#include "document/animation.h"
#include "support/files.h"
#include "support/posed_cube.h"

namespace viete::test {

/// Returns the cage rotated about z and moved along x. `pull` moves one vertex, so that no pose is rigid.
inline pose::Pose turned_cage(const pose::Cage& cage, double degrees, double along = 0, double pull = 0.5) {
  const double a = degrees / 180 * 3.14159265358979323846;
  pose::Pose pose = pose::rest_pose(cage);
  pose.positions[7][2] += pull;
  for (auto& p : pose.positions)
    p = {std::cos(a) * p[0] - std::sin(a) * p[1] + along, std::sin(a) * p[0] + std::cos(a) * p[1], p[2]};
  return pose;
}

/// A document of a cube and its cage, with three keys: rest at frame 1, a rotation by 90 degrees at frame 9,
/// and a rotation by 190 degrees at frame 17.
struct AnimatedCube : CubeFiles {
  document::Document document = document::open_document(model, cage);

  AnimatedCube() {
    const pose::Cage& c = *document.cage();
    document.changed_timeline().keys = {{1, whole(pose::rest_pose(c))},
                                        {9, whole(turned_cage(c, 90, 1))},
                                        {17, whole(turned_cage(c, 190, 1, -0.25))}};
    document.changed_timeline().first = 1;
    document.changed_timeline().last = 17;
  }

  document::WholePose pose(double frame) const {
    document::VectorCache vectors;
    vectors.follow(document.cage());
    return document::Animation(document.timeline(), vectors).at(frame);
  }
};

}  // namespace viete::test
