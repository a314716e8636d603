// Poses of a cage as vectors, and back: shapes whose parts remember how often they turned.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "deform/log_space.h"
#include "deform/maps.h"

namespace viete::deform {

/// Takes poses of one cage to vectors and back, by its triangles, whatever elements the model is bound with.
/// The whole turns of a vector are those that its logs cannot tell, which are about another axis than the one
/// that a part is turned about: see choose_branches(). Constant once it is made: thread-safe.
class PoseSpace {
public:
  /// Throws base::Error: see LogSpace.
  explicit PoseSpace(std::shared_ptr<const Cage> cage);

  const Cage& cage() const { return *cage_; }
  /// Sums, and where a pose is held on its way.
  const LogSpace& logs() const { return logs_; }
  /// Of whole turns those that the pose has, or, if it says nothing of them, those nearest to `turns_before`,
  /// as of the pose that came before it (missing: 0). Throws base::Error if the pose has not one position per
  /// vertex.
  LogVector vector(const Pose& pose, std::span<const Vec3> turns_before = {}) const;
  /// The pose of a sum of vectors.
  Pose pose(std::span<const LogTerm> terms, const Held& held) const;
  /// The same with each vertex on its straight way.
  Pose straight(std::span<const LogTerm> terms) const;

private:
  std::vector<Vec3> take_wholes(std::span<const AffineMap> maps, std::span<const MapSplit> splits,
                                const LogReport& report, std::vector<MapLog>& logs) const;
  std::vector<Vec3> turns(std::span<const LogTerm> terms) const;

  std::shared_ptr<const Cage> cage_;
  LogSpace logs_;
};

}  // namespace viete::deform
