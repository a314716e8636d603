#include "bench/modes_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <vector>

#include "bench/mode_comparison.h"

namespace viete::bench {

namespace {

// Lines fit 130 columns if names of schemes have at most 36 characters.
constexpr int column = 9;

void print_cell(double value, const char* format) {
  char text[32] = "-";
  if (!std::isnan(value)) std::snprintf(text, sizeof text, format, value);
  std::printf("%*s", column, text);
}

void print_deviation(double value) {
  if (value <= exactly) return (void)std::printf("%*s", column, "exact");
  print_cell(value, "%.1e");
}

// "smooth: face, biharmonic, srl".
std::string name_of(const Mode& mode) {
  const auto way = deform::way_of(mode.scheme);
  return (way ? std::string(deform::entry(*way).name) + ": " : "") + deform::text(mode.scheme);
}

int name_width(std::span<const Mode> modes) {
  std::size_t longest = 0;
  for (const Mode& mode : modes) longest = std::max(longest, name_of(mode).size());
  return static_cast<int>(longest) + 2;
}

/// A line for each scheme that was measured.
template <class Row>
void print_rows(const std::string& title, std::initializer_list<const char*> columns,
                std::span<const Mode> modes, const Row& row) {
  const int width = name_width(modes);
  std::printf("\n%-*s", width, title.c_str());
  for (const char* name : columns) std::printf("%*s", column, name);
  for (const Mode& mode : modes) {
    if (!mode.problem.empty()) continue;
    std::printf("\n  %-*s", width - 2, name_of(mode).c_str());
    row(mode);
  }
  std::printf("\n");
}

void print_modes(std::span<const Mode> modes) {
  print_rows("by themselves", {"moved", "rigid", "similar", "affine", "leak", "frame", "bind"}, modes,
             [](const Mode& mode) {
               for (const double d : mode.deviations) print_deviation(d);
               print_cell(mode.leak, "%.1e");
               print_cell(mode.frame_ms, mode.fused ? "%.3f" : "%.3f*");
               print_cell(mode.bind_ms, "%.1f");
             });
}

void print_pose(std::span<const Mode> modes, const std::string& name, std::size_t p) {
  print_rows(name,
             {"volume", "energy", "x mvc", "shear", "worst", "bending", "x mvc", "gap", "torn", "x mvc"},
             modes, [p](const Mode& mode) {
               const ShapeQuality& q = mode.qualities[p];
               print_cell(q.volume, "%.4f");
               print_cell(q.distortion.energy, "%.3g");
               print_cell(q.energy_ratio, "%.3f");
               print_cell(q.distortion.median_shear, "%.3f");
               print_cell(q.distortion.worst_shear, "%.3g");
               print_cell(q.bending, "%.3g");
               print_cell(q.bending_ratio, "%.3f");
               print_cell(q.gap, "%.4f");
               print_cell(q.torn, "%.2e");
               print_cell(q.torn_ratio, "%.2f");
             });
}

void print_all_poses(std::span<const Mode> modes, std::size_t poses) {
  print_rows("all " + std::to_string(poses) + " poses",
             {"volume", "to", "energy", "worst", "bending", "worst", "gap", "torn", "x mvc"}, modes,
             [&](const Mode& mode) {
               const auto volumes = over_poses(mode, [](const auto& q) { return q.volume; });
               print_cell(volumes.least, "%.4f");
               print_cell(volumes.most, "%.4f");
               for (const auto& ratios : {over_poses(mode, [](const auto& q) { return q.energy_ratio; }),
                                          over_poses(mode, [](const auto& q) { return q.bending_ratio; })}) {
                 print_cell(ratios.middle, "%.3f");
                 print_cell(ratios.most, "%.3f");
               }
               print_cell(over_poses(mode, [](const auto& q) { return q.gap; }).middle, "%.4f");
               print_cell(over_poses(mode, [](const auto& q) { return q.torn; }).most, "%.2e");
               print_cell(over_poses(mode, [](const auto& q) { return q.torn_ratio; }).most, "%.2f");
             });
  std::printf("  (energy and bending x mvc: median and worst; gap: median; torn: worst)\n");
}

void print_notes(const ModeComparison& compared, std::span<const NamedPose> poses) {
  std::printf("\ngap at rest: %.4f\n", compared.rest_gap);
  if (!compared.encloses) std::printf("note: the model is not closed, and has no volume to compare\n");
  if (compared.without_area)
    std::printf("note: %zu triangles of the model have no area at rest and are left out\n",
                compared.without_area);
  for (const auto& warning : compared.warnings) std::printf("note: %s\n", warning.c_str());
  for (const Mode& mode : compared.modes) {
    const std::string name = name_of(mode);
    if (!mode.problem.empty()) std::printf("note: no %s: %s\n", name.c_str(), mode.problem.c_str());
    for (std::size_t p = 0; p < mode.qualities.size(); ++p) {
      if (const auto collapsed = mode.qualities[p].distortion.collapsed)
        std::printf("note: %s, %s: %zu triangles have collapsed\n", name.c_str(), poses[p].name.c_str(),
                    collapsed);
    }
  }
}

nlohmann::json to_json(const ShapeQuality& q, const std::string& pose) {
  return {{"pose", pose},
          {"volume", q.volume},
          {"energy", q.distortion.energy},
          {"energy_to_mean_value", q.energy_ratio},
          {"median_shear", q.distortion.median_shear},
          {"worst_shear", q.distortion.worst_shear},
          {"collapsed", q.distortion.collapsed},
          {"bending", q.bending},
          {"bending_to_mean_value", q.bending_ratio},
          {"gap", q.gap},
          {"torn", q.torn},
          {"torn_to_mean_value", q.torn_ratio}};
}

nlohmann::json to_json(const Mode& mode, std::span<const NamedPose> poses) {
  const deform::Scheme& scheme = mode.scheme;
  nlohmann::json json = {{"name", deform::text(scheme)},
                         {"weights", deform::entry(scheme.weighting.weights).name},
                         {"blend", deform::entry(scheme.blend).name}};
  if (const auto way = deform::way_of(scheme)) json["way"] = deform::entry(*way).name;
  if (!mode.problem.empty()) {
    json["problem"] = mode.problem;
    return json;
  }
  for (std::size_t i = 0; i < mode.deviations.size(); ++i)
    json["deviations"][whole_poses()[i].name] = mode.deviations[i];
  json["leak"] = mode.leak;
  json["fused"] = mode.fused;
  json["frame_ms"] = mode.frame_ms;
  json["bind_ms"] = mode.bind_ms;
  for (std::size_t p = 0; p < poses.size(); ++p)
    json["poses"].push_back(to_json(mode.qualities[p], poses[p].name));
  return json;
}

}  // namespace

OverPoses over_poses(const Mode& mode, const std::function<double(const ShapeQuality&)>& value) {
  std::vector<double> values;
  for (const ShapeQuality& q : mode.qualities) values.push_back(value(q));
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return {std::nan(""), std::nan(""), std::nan("")};
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2], values.back()};
}

void print(const ModeComparison& compared, std::span<const NamedPose> poses) {
  const std::vector<Mode>& modes = compared.modes;
  print_modes(modes);
  for (std::size_t p = 0; p < poses.size(); ++p) print_pose(modes, poses[p].name, p);
  if (poses.size() > 1) print_all_poses(modes, poses.size());
  print_notes(compared, poses);
}

nlohmann::json to_json(const ModeComparison& compared, std::span<const NamedPose> poses) {
  nlohmann::json results = nlohmann::json::array();
  for (const Mode& mode : compared.modes) results.push_back(to_json(mode, poses));
  return {{"figure", "modes"}, {"rest_gap", compared.rest_gap}, {"results", results}};
}

}  // namespace viete::bench
