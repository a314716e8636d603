// Converts poses of a cage to vectors and back, including the whole turns of each part.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pose/cage.h"
#include "pose/maps.h"
#include "shapes/log_space.h"

namespace viete::shapes {

/// Converts poses of one cage to vectors and back. Uses the cage's elements, even if a binding uses
/// vertices. Logs cannot represent whole turns about another axis than the axis of the part's rotation, see
/// choose_branches(). LogVector::wholes stores such turns. Thread-safe.
class PoseSpace {
public:
  /// Throws base::Error as LogSpace does.
  explicit PoseSpace(std::shared_ptr<const pose::Cage> cage);

  const pose::Cage& cage() const { return *cage_; }
  /// The log space, for sums of vectors and the anchors of a moving pose.
  const LogSpace& logs() const { return logs_; }
  /// Converts a pose to a vector. If the pose has no turns, chooses the turns nearest to `turns_before`, the
  /// turns of the preceding pose (0 if missing). Throws base::Error if the number of positions is wrong.
  LogVector vector(const pose::Pose& pose, std::span<const Vec3> turns_before = {}) const;
  /// Returns the pose of the sum of `terms`.
  pose::Pose pose(std::span<const LogTerm> terms, const AnchorWeights& anchors) const;
  /// Returns the linear sum of the poses' positions: every vertex moves on a straight line.
  pose::Pose linear(std::span<const LogTerm> terms) const;

private:
  std::vector<Vec3> take_wholes(std::span<const pose::AffineMap> maps, std::span<const pose::MapSplit> splits,
                                const pose::LogReport& report, std::vector<pose::MapLog>& logs) const;
  std::vector<Vec3> turns(std::span<const LogTerm> terms) const;

  std::shared_ptr<const pose::Cage> cage_;
  LogSpace logs_;
};

}  // namespace viete::shapes
