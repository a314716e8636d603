// A pose of the cage: the maps of its elements, their logs, and the rows that engines sum.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "pose/cage.h"
#include "pose/deformer.h"
#include "pose/maps.h"
#include "pose/rows.h"
#include "pose/stages.h"

namespace viete::pose {

RowForm row_form(Elements elements, Blend blend);
const RowShape& shape(RowForm form);

std::size_t handle_count(const Cage& cage, Elements elements);
std::span<const mesh::Point> handle_centers(const Cage& cage, Elements elements);

/// The rows of all handles in a pose. Positions are relative to `origin`.
struct Rows {
  RowForm form = RowForm::positions;
  std::span<const double> values;  ///< [handle][column]
  Vec3 origin{0, 0, 0};
  double moment_length = 1;  ///< the length l of moments.h; only used by moment forms

  std::size_t columns() const { return shape(form).columns; }
  std::size_t count() const { return values.size() / columns(); }
};

/// Computes the maps, logs and rows of a pose, without the model. During a drag, computes only the maps of
/// elements with moved vertices, and keeps the origin. The rows of other elements keep all bits unless their
/// logs change, for example to another branch. Not thread-safe.
class CageState {
public:
  /// cage must not be null.
  CageState(std::shared_ptr<const Cage> cage, Elements elements, Blend blend)
      : CageState(std::move(cage), elements, row_form(elements, blend)) {}
  /// If the elements are points and the form has maps, each point has the map of the patch around the point.
  CageState(std::shared_ptr<const Cage> cage, Elements elements, RowForm form);

  /// Throws base::Error unless pose.positions has one entry per cage vertex.
  void set_pose(const Pose& pose);
  /// Until end_drag(), all cage vertices except these must keep the positions of the last pose.
  void begin_drag(std::span<const std::uint32_t> vertices);
  void end_drag();
  /// Sets the amounts for the next poses. If the amounts change, the next pose computes all elements again.
  void set_amounts(const Amounts& amounts);
  /// If `keep`, the origin of the next poses is the middle of the rest cage; otherwise pose_origin().
  void keep_origin(bool keep);

  const Cage& cage() const { return *cage_; }
  Rows rows() const;
  /// The handles that move in the current drag, in ascending order; empty if there is no drag.
  std::span<const std::uint32_t> moving() const { return moving_; }
  /// Increases when a drag begins, and when rows of handles outside moving() may have changed.
  unsigned long resting_revision() const { return resting_revision_; }
  /// The report of the last pose. If the rows do not use logs, the report contains only turns.
  const LogReport& report() const { return report_; }
  const StageTimes& times() const { return times_; }

private:
  // Update all handles or, if `few`, only moving_. Return true if rows outside moving_ may have changed.
  bool set_positions(const Pose& pose, bool few);
  bool set_maps(const Pose& pose, bool few);
  bool takes_logs() const;
  void compute_maps(std::span<const mesh::Point> posed, const Vec3& origin,
                    std::span<const std::uint32_t> which);
  void write_row_of(std::uint32_t handle);
  bool others_stayed() const;

  std::shared_ptr<const Cage> cage_;
  RowForm form_;
  double moment_length_;
  Amounts amounts_;
  bool keeps_origin_ = false;
  std::optional<VertexPatches> patches_;     // only if the elements are points with maps
  std::vector<std::uint32_t> all_, moving_;  // indices of handles
  Vec3 origin_{0, 0, 0};
  bool posed_ = false;
  std::vector<AffineMap> maps_;
  std::vector<MapSplit> splits_;
  std::vector<MapLog> logs_, logs_before_;
  std::vector<double> values_;
  std::vector<Vec3> rest_centers_;  // relative to the middle of the rest cage
  unsigned long resting_revision_ = 0;
  LogReport report_;
  StageTimes times_;
};

}  // namespace viete::pose
