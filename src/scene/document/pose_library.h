// Poses with names, and what is mixed of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/document/range.h"
#include "scene/document/timeline.h"

namespace viete::scene {

struct NamedPose {
  std::string name;
  SharedPose pose;
  double weight = 0;                  ///< in what is shown: 0 none of it, 1 all, also beyond and below
  std::vector<std::uint32_t> part{};  ///< vertices of the cage that it moves; empty: all

  friend bool operator==(const NamedPose&, const NamedPose&) = default;
};

struct NamedShape {
  std::string name;
  SharedShape shape;  ///< never null
};

/// In an order of the user's. The document's pose is `unmixed` and the weighted poses upon it, added in log
/// space or, as the timeline, in straight lines; a hand that moves the cage moves `unmixed` with it.
struct PoseLibrary {
  static constexpr double least_weight = -2, largest_weight = 3;
  static constexpr std::size_t most_poses = 1000, longest_name = 200;

  std::vector<NamedPose> poses;
  SharedPose unmixed{};  ///< what is there without the mix; null while nothing is mixed
  SharedPose mixed{};    ///< the pose with it: the document's, until something else has changed that

  bool mixes() const;
  friend bool operator==(const PoseLibrary& a, const PoseLibrary& b) { return a.poses == b.poses; }
};

/// A blend of probes' poses by their logs; those that are missing are at rest.
struct ProbeTerm {
  const std::vector<deform::ProbePose>* poses;
  double factor;
};
std::vector<deform::ProbePose> blended_probes(std::span<const ProbeTerm> terms);

/// True if it can be drawn, as far as such coordinates can, and kept in a session: the ranges of
/// scene/document/range.h. Sums of logs may leave them.
bool in_range(const WholePose& pose, double farthest = most_drawn);
/// The same places, to the last bit, and the same whole turns; of what each part is turned by, only these
/// tell poses apart.
bool same_pose(const deform::Pose& a, const deform::Pose& b);
/// Likewise with the same shape and probes, of which those that are missing are at rest.
bool same_pose(const WholePose& a, const WholePose& b);

}  // namespace viete::scene
