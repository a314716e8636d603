// Poses of the cube's cage, and a timeline with three keys.
#pragma once

#include <cmath>
#include <numbers>

#include "document/pose_edit.h"
#include "document/time_edit.h"
#include "support/cube.h"
#include "support/distance.h"

namespace viete::test {

/// Returns the positions rotated about z.
inline std::vector<mesh::Point> turned(std::vector<mesh::Point> positions, double degrees) {
  const double angle = degrees / 180 * std::numbers::pi, c = std::cos(angle), s = std::sin(angle);
  for (auto& p : positions) p = {c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
  return positions;
}

/// Returns the cage rotated about z. The angle may be above 360 degrees: the pose counts full turns.
inline pose::Pose turned_cube(double degrees) {
  return {turned(cube(1.5).positions, degrees), {{0, 0, degrees / 180 * std::numbers::pi}}};
}

/// Returns the cage scaled along x and z.
inline pose::Pose stretched_cube(double x, double z = 1) {
  pose::Pose pose{cube(1.5).positions, {{0, 0, 0}}};
  for (auto& p : pose.positions) {
    p[0] *= x;
    p[2] *= z;
  }
  return pose;
}

inline document::SharedPose whole(pose::Pose pose, std::vector<pose::ProbePose> probes = {}) {
  return std::make_shared<const document::WholePose>(document::WholePose{std::move(pose), std::move(probes)});
}

inline document::PoseKey key(int frame, const pose::Pose& pose,
                             document::Easing easing = document::Easing::smooth) {
  return {frame, whole(pose), easing};
}

/// Returns a timeline with keys: rest at frame 1, half a turn at frame 11, twice the width at frame 31.
inline document::Timeline three_keys() {
  document::Timeline timeline;
  timeline.keys = {key(1, turned_cube(0)), key(11, turned_cube(180)), key(31, stretched_cube(2))};
  timeline.last = 31;
  return timeline;
}

/// Adds two named poses: "turned" (by 90 degrees) and "wide" (twice the width).
inline void add_two_poses(document::Document& document) {
  document.changed_library().poses = {{"turned", whole(turned_cube(90))}, {"wide", whole(stretched_cube(2))}};
}

/// Returns the largest distance between corresponding vertices, in diagonals of the cage.
inline double distance(const std::vector<mesh::Point>& a, const std::vector<mesh::Point>& b) {
  return largest_distance(a, b) / (3 * std::sqrt(3.0));
}

}  // namespace viete::test
