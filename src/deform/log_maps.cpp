#include "deform/log_maps.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "deform/branches.h"
#include "deform/polar.h"
#include "deform/vec3.h"

namespace viete::deform {

namespace {

using Rotations = std::vector<sym3::Mat3<double>>;

constexpr double flatness_floor = 1e-3;   // of the element's largest stretch
constexpr double size_floor = 1e-4;       // of the pose's mean stretch
constexpr double smallest_floor = 1e-12;  // where the whole pose is one point

// Geometric mean of the elements' largest stretches: what size the pose has as a whole.
double mean_stretch(const Cage& cage, const std::vector<Polar>& polars) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t e = 0; e < polars.size(); ++e) {
    if (cage.degenerate[e] || !(polars[e].stretches[0] > 0)) continue;
    sum += std::log(polars[e].stretches[0]);
    ++count;
  }
  return count ? std::exp(sum / static_cast<double>(count)) : 0;
}

// Raises small stretches; true if one was below the floor.
bool raise(Polar& polar, double mean) {
  double floor = std::max(flatness_floor * polar.stretches[0], size_floor * mean);
  if (!(floor > 0)) floor = smallest_floor;
  bool raised = false;
  for (double& s : polar.stretches) {
    if (s >= floor) continue;
    s = floor;
    raised = true;
  }
  return raised;
}

bool finite(const sym3::Mat3<double>& m) {
  return std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); });
}

// Stretch logs and centres; returns the rotations, of which the branches are yet to be chosen.
Rotations split(const Cage& cage, std::span<const FaceMap> maps, std::span<MapLog> logs, LogReport& report) {
  std::vector<Polar> polars(maps.size());
  const Polar identity{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 1, 1}};
  for (std::size_t e = 0; e < maps.size(); ++e) {
    const bool usable = !cage.degenerate[e] && finite(maps[e].linear);
    polars[e] = usable ? polar(maps[e].linear) : identity;
  }
  const double mean = mean_stretch(cage, polars);
  Rotations rotations(maps.size());
  for (std::uint32_t e = 0; e < maps.size(); ++e) {
    const bool raised = !cage.degenerate[e] && (raise(polars[e], mean) || !finite(maps[e].linear));
    if (raised) report.collapsed.push_back(e);
    rotations[e] = polars[e].rotation;
    logs[e] = {log_stretch(polars[e]), {0, 0, 0}, maps[e].center};
  }
  return rotations;
}

bool torn(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b, const Vec3& log_a, const Vec3& log_b) {
  return alignment(a, b) < 0 || norm(log_a - log_b) > std::numbers::pi;
}

}  // namespace

void log_maps(const Cage& cage, std::span<const FaceMap> maps, std::span<const Vec3> turns,
              std::span<MapLog> logs, LogReport& report) {
  report = {};
  const Rotations rotations = split(cage, maps, logs, report);
  Branches branches = choose_branches(cage, rotations, turns);
  for (std::size_t e = 0; e < logs.size(); ++e) logs[e].rotation = branches.logs[e];
  report.turns = std::move(branches.turns);
  for (const auto& pair : cage.dual_edges) {
    const auto [i, j] = pair;
    if (torn(rotations[i], rotations[j], logs[i].rotation, logs[j].rotation)) report.torn.push_back(pair);
  }
}

}  // namespace viete::deform
