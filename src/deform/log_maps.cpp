#include "deform/log_maps.h"

#include <algorithm>
#include <numbers>

#include "deform/branches.h"
#include "deform/polar.h"

namespace viete::deform {

namespace {

constexpr double flatness_floor = 1e-3;   // of the element's largest stretch
constexpr double size_floor = 1e-4;       // of the pose's mean stretch
constexpr double smallest_floor = 1e-12;  // where the whole pose is one point

double floor_of(double largest, double mean) {
  const double floor = std::max(flatness_floor * largest, size_floor * mean);
  return floor > 0 ? floor : smallest_floor;
}

bool finite(const sym3::Mat3<double>& m) {
  return std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); });
}

// By its singular values. True if one was below the floor.
bool split_collapsed(const AffineMap& map, double mean, MapSplit& split) {
  const bool usable = finite(map.linear);
  Polar p =
      usable ? polar(map.linear) : Polar{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 1, 1}};
  const double floor = floor_of(p.stretches[0], mean);
  const bool raised = p.stretches[2] < floor;
  for (double& s : p.stretches) s = std::max(s, floor);
  split.rotation = p.rotation;
  split.stretch = log_stretch(p);
  split.turn = sym3::log_rotation(p.rotation);
  return raised || !usable;
}

bool torn(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b, const Vec3& log_a, const Vec3& log_b) {
  return alignment(a, b) < 0 || norm(log_a - log_b) > std::numbers::pi;
}

}  // namespace

double mean_stretch(std::span<const std::uint8_t> skipped, std::span<const double> largest) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t e = 0; e < largest.size(); ++e) {
    if (skipped[e] || !(largest[e] > 0)) continue;
    sum += std::log(largest[e]);
    ++count;
  }
  return count ? std::exp(sum / static_cast<double>(count)) : 0;
}

bool is_ordinary(double least, double largest, double mean) {
  return least >= floor_of(largest, mean);
}

bool raise_to_floor(const AffineMap& map, double mean, MapSplit& split) {
  return !is_ordinary(split.least, split.largest, mean) && split_collapsed(map, mean, split);
}

void log_maps(const Cage& cage, std::span<const AffineMap> maps, std::span<const MapSplit> splits,
              std::span<const Vec3> turns, std::span<MapLog> logs, LogReport& report) {
  report = {};
  std::vector<double> largest;
  for (const MapSplit& split : splits) largest.push_back(split.largest);
  const double mean = mean_stretch(cage.degenerate, largest);
  std::vector<sym3::Mat3<double>> rotations(maps.size());
  std::vector<Vec3> principal(maps.size());
  for (std::uint32_t e = 0; e < maps.size(); ++e) {
    MapSplit split = splits[e];
    if (!cage.degenerate[e] && raise_to_floor(maps[e], mean, split)) report.collapsed.push_back(e);
    rotations[e] = split.rotation;
    principal[e] = split.turn;
    logs[e] = {split.stretch, {0, 0, 0}, maps[e].center};
  }
  Branches branches = choose_branches(cage, rotations, principal, turns);
  for (std::size_t e = 0; e < logs.size(); ++e) logs[e].rotation = branches.logs[e];
  report.turns = std::move(branches.turns);
  for (const auto& pair : cage.dual_edges) {
    const auto [i, j] = pair;
    if (torn(rotations[i], rotations[j], logs[i].rotation, logs[j].rotation)) report.torn.push_back(pair);
  }
}

}  // namespace viete::deform
