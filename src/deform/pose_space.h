// Poses of a cage as vectors, and back, with the whole turns of each part.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "deform/log_space.h"
#include "deform/maps.h"

namespace viete::deform {

/// Converts poses of one cage to vectors and back. Uses the cage's triangles for any kind of bound elements.
/// The whole turns of a vector are those that its logs cannot represent: turns about another axis than that
/// of the part's rotation, see choose_branches(). Constant after construction: thread-safe.
class PoseSpace {
public:
  /// Throws base::Error: see LogSpace.
  explicit PoseSpace(std::shared_ptr<const Cage> cage);

  const Cage& cage() const { return *cage_; }
  /// Sums, and the anchors of a moving pose.
  const LogSpace& logs() const { return logs_; }
  /// Takes the whole turns of the pose or, if it has none, those nearest to `turns_before`, the turns of the
  /// preceding pose (missing: 0). Throws base::Error unless the pose has one position per vertex.
  LogVector vector(const Pose& pose, std::span<const Vec3> turns_before = {}) const;
  /// The pose of a sum of vectors.
  Pose pose(std::span<const LogTerm> terms, const Held& held) const;
  /// The linear sum: every vertex moves on a straight line.
  Pose straight(std::span<const LogTerm> terms) const;

private:
  std::vector<Vec3> take_wholes(std::span<const AffineMap> maps, std::span<const MapSplit> splits,
                                const LogReport& report, std::vector<MapLog>& logs) const;
  std::vector<Vec3> turns(std::span<const LogTerm> terms) const;

  std::shared_ptr<const Cage> cage_;
  LogSpace logs_;
};

}  // namespace viete::deform
