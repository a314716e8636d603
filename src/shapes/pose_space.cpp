#include "shapes/pose_space.h"

#include "pose/branches.h"
#include "pose/cage_state.h"
#include "pose/maps.h"

namespace viete::shapes {

namespace {

// If a part's turn and the mean of its logs differ by more than this many radians, the logs lack whole turns.
constexpr double tells_turns = 0.5;

LogSpace logs_of(const pose::Cage& cage) {
  base::WorkerPool one(1);
  return LogSpace(
      {cage.elements.positions, cage.elements.triangles, cage.degenerate, cage.parts, cage.roots.size()},
      one);
}

}  // namespace

PoseSpace::PoseSpace(std::shared_ptr<const pose::Cage> cage)
    : cage_(std::move(cage)), logs_(logs_of(*cage_)) {}

// Returns the whole turns that the logs of a part cannot represent, and removes these turns from the logs.
std::vector<Vec3> PoseSpace::take_wholes(std::span<const pose::AffineMap> maps,
                                         std::span<const pose::MapSplit> splits,
                                         const pose::LogReport& report,
                                         std::vector<pose::MapLog>& logs) const {
  std::vector<Vec3> wholes(report.turns.size()), rotations;
  for (const pose::MapLog& log : logs) rotations.push_back(log.rotation);
  const std::vector<Vec3> means = means_of_parts(*cage_, rotations);
  std::vector<pose::MapLog> least(logs.size());
  pose::LogReport of_least;
  for (std::size_t part = 0; part < wholes.size(); ++part) {
    if (norm(report.turns[part] - means[part]) < tells_turns) continue;
    if (of_least.turns.empty()) log_maps(*cage_, maps, splits, {}, least, of_least);
    const Vec3& turn = report.turns[part];
    const double count = pose::whole_turns(turn, of_least.turns[part]);
    if (count == 0) continue;
    wholes[part] = pose::with_whole_turns((1 / norm(turn)) * turn, count, {0, 0, 0});
    for (std::size_t e = 0; e < logs.size(); ++e)
      if (cage_->parts[e] == part) logs[e] = least[e];
  }
  return wholes;
}

LogVector PoseSpace::vector(const pose::Pose& pose, std::span<const Vec3> turns_before) const {
  check_pose(*cage_, pose.positions.size());
  const auto all = pose::first_numbers(cage_->element_count());
  std::vector<pose::AffineMap> maps(all.size());
  std::vector<pose::MapSplit> splits(all.size());
  std::vector<pose::MapLog> logs(all.size());
  face_maps(*cage_, pose.positions, pose_origin(*cage_, pose.positions), all, maps);
  split_maps(maps, all, splits);
  pose::LogReport report;
  log_maps(*cage_, maps, splits, pose.turns.empty() ? turns_before : pose.turns, logs, report);

  LogVector vector;
  vector.wholes = take_wholes(maps, splits, report, logs);
  for (const pose::MapLog& log : logs) vector.logs.push_back(numbers(log));
  vector.turns = std::move(report.turns);
  base::WorkerPool one(1);
  logs_.complete(with_centers(*cage_, pose.positions), one, vector);
  return vector;
}

std::vector<Vec3> PoseSpace::turns(std::span<const LogTerm> terms) const {
  std::vector<Vec3> turns(cage_->roots.size());
  for (const auto& [vector, factor] : terms)
    for (std::size_t part = 0; part < turns.size(); ++part)
      turns[part] = turns[part] + factor * vector->turns[part];
  return turns;
}

pose::Pose PoseSpace::pose(std::span<const LogTerm> terms, const AnchorWeights& anchors) const {
  pose::Pose pose{std::vector<mesh::Point>(logs_.rest().size()), turns(terms)};
  base::WorkerPool one(1);
  LogSpace::Work work;
  logs_.shape(terms, anchors, one, work, pose.positions);
  pose.positions.resize(cage_->surface.positions.size());
  return pose;
}

pose::Pose PoseSpace::linear(std::span<const LogTerm> terms) const {
  pose::Pose pose{std::vector<mesh::Point>(logs_.rest().size()), turns(terms)};
  logs_.linear(terms, pose.positions);
  pose.positions.resize(cage_->surface.positions.size());
  return pose;
}

}  // namespace viete::shapes
