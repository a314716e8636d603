#include "scene/pose_notes.h"

namespace viete::scene {

namespace {

std::string plural(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

}  // namespace

std::vector<std::string> pose_notes(const deform::LogReport& report) {
  std::vector<std::string> notes;
  if (!report.collapsed.empty()) {
    notes.push_back(
        plural(report.collapsed.size(), "cage triangle has", "cage triangles have") +
        " collapsed (first: " + std::to_string(report.collapsed.front()) +
        (report.collapsed.size() == 1 ? "); its stretch is floored" : "); their stretches are floored"));
  }
  if (!report.torn.empty()) {
    const auto& [a, b] = report.torn.front();
    notes.push_back(plural(report.torn.size(), "pair", "pairs") +
                    " of cage neighbours turned by over 120 degrees (first: " + std::to_string(a) + ", " +
                    std::to_string(b) + "); the mesh may fold there");
  }
  return notes;
}

}  // namespace viete::scene
