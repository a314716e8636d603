#include "scene/document/pose_notes.h"

#include <algorithm>
#include <iterator>
#include <ranges>

#include "base/text.h"

namespace viete::scene {

namespace {

// Of each part of the cage, signed: positive when its faces look outward. In units of the cage's size.
std::vector<double> volumes(const deform::Cage& cage, const std::vector<mesh::Point>& positions) {
  std::vector<double> all(cage.roots.size(), 0);
  for (std::size_t e = 0; e < cage.element_count(); ++e) {
    if (cage.parts[e] >= all.size()) continue;
    const auto& center = positions[cage.surface.triangles[cage.roots[cage.parts[e]]][0]];
    mesh::Vec3 corners[3];
    for (int i = 0; i < 3; ++i)
      corners[i] = (1 / cage.diagonal) * (positions[cage.surface.triangles[e][i]] - center);
    all[cage.parts[e]] += mesh::dot(corners[0], mesh::cross(corners[1], corners[2])) / 6;
  }
  return all;
}

std::size_t parts_inside_out(const deform::Cage& cage, const deform::Pose& pose) {
  if (!cage.closed) return 0;
  const auto rest = volumes(cage, cage.surface.positions), posed = volumes(cage, pose.positions);
  std::size_t count = 0;
  for (std::size_t part = 0; part < rest.size(); ++part) count += rest[part] * posed[part] < 0;
  return count;
}

std::string inside_out_note(std::size_t count, std::size_t parts) {
  const std::string which = parts == 1
                                ? "The cage is"
                                : std::to_string(count) + " of " + std::to_string(parts) +
                                      (count == 1 ? " parts of the cage is" : " parts of the cage are");
  return which +
         " turned inside out in this pose, as by a mirror, which no turning and stretching does: the "
         "mesh folds; mean value coordinates can follow";
}

}  // namespace

std::vector<std::string> pose_notes(const deform::LogReport& report, const deform::Cage& cage,
                                    const deform::Pose& pose) {
  std::vector<std::string> notes;
  if (!report.collapsed.empty()) {
    notes.push_back(
        std::to_string(report.collapsed.size()) + std::string(" of the cage's faces") +
        (report.collapsed.size() == 1 ? " has" : " have") +
        " collapsed (first: " + std::to_string(report.collapsed.front()) +
        (report.collapsed.size() == 1 ? "); its stretch is floored" : "); their stretches are floored"));
  }
  if (report.torn.empty()) return notes;
  const std::size_t inside_out = parts_inside_out(cage, pose);
  if (inside_out > 0) notes.push_back(inside_out_note(inside_out, cage.roots.size()));
  if (inside_out < cage.roots.size()) {
    const auto& [a, b] = report.torn.front();
    notes.push_back(base::counted(report.torn.size(), "pair") +
                    " of cage neighbours turned by over 120 degrees (first: faces " + std::to_string(a) +
                    ", " + std::to_string(b) + "); the mesh may fold there");
  }
  return notes;
}

std::vector<std::array<std::uint32_t, 2>> torn_edges(const deform::LogReport& report,
                                                     const deform::Cage& cage, std::size_t most) {
  const auto& triangles = cage.surface.triangles;
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& [a, b] : report.torn | std::views::take(most)) {
    if (std::max(a, b) >= triangles.size()) continue;
    std::vector<std::uint32_t> ends;
    std::ranges::copy_if(triangles[a], std::back_inserter(ends), [&, other = b](std::uint32_t v) {
      return std::ranges::count(triangles[other], v) > 0;
    });
    if (ends.size() == 2) edges.push_back({ends[0], ends[1]});
  }
  return edges;
}

}  // namespace viete::scene
