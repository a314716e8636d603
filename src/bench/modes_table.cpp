#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/text.h"
#include "bench/modes.h"
#include "bench/table.h"
#include "sym3/kernel.h"

namespace viete::bench {

namespace {

constexpr const char* modes_legend =
    R"(  moved, rigid, similar, affine: largest distance of the model from a map of this kind that poses the
    whole cage, in diagonals; exact: below 1e-9
  leak: one cage vertex moves by a tenth of the diagonal; how far vertices more than a quarter of the diagonal
    away move, in diagonals; median over the model and over 8 cage vertices
  frame, bind: processor time of one thread in ms; *: stage by stage, in double
  volume: relative to rest
  energy: symmetric Dirichlet energy of the triangles, mean by area, 0 at rest
  x mvc: relative to mean value coordinates
  bending: energy of the changes of angle between triangles (discrete shells); kinks increase it
  gap: mean distance of the surface from the posed nearest points of the cage, in diagonals
  torn: largest change of distance between vertices close at rest but not joined by edges, in diagonals
)";

/// A member of ShapeQuality, with its column in the table of a pose and its key in JSON.
struct Measure {
  const char *column, *key;
  double ShapeQuality::*value;
  const char* format;
};

constexpr Measure measures[] = {{"volume", "volume", &ShapeQuality::volume, "%.4f"},
                                {"energy", "energy", &ShapeQuality::energy, "%.3g"},
                                {"x mvc", "energy_to_mean_value", &ShapeQuality::energy_ratio, "%.3f"},
                                {"bending", "bending", &ShapeQuality::bending, "%.3g"},
                                {"x mvc", "bending_to_mean_value", &ShapeQuality::bending_ratio, "%.3f"},
                                {"gap", "gap", &ShapeQuality::gap, "%.4f"},
                                {"torn", "torn", &ShapeQuality::torn, "%.2e"},
                                {"x mvc", "torn_to_mean_value", &ShapeQuality::torn_ratio, "%.2f"}};

struct Summary {
  const char* column;
  double ShapeQuality::*value;
  double OverPoses::*over;
  const char* format;
};

constexpr Summary summaries[] = {{"volume", &ShapeQuality::volume, &OverPoses::least, "%.4f"},
                                 {"to", &ShapeQuality::volume, &OverPoses::most, "%.4f"},
                                 {"energy", &ShapeQuality::energy_ratio, &OverPoses::middle, "%.3f"},
                                 {"worst", &ShapeQuality::energy_ratio, &OverPoses::most, "%.3f"},
                                 {"bending", &ShapeQuality::bending_ratio, &OverPoses::middle, "%.3f"},
                                 {"worst", &ShapeQuality::bending_ratio, &OverPoses::most, "%.3f"},
                                 {"gap", &ShapeQuality::gap, &OverPoses::middle, "%.4f"},
                                 {"torn", &ShapeQuality::torn, &OverPoses::most, "%.2e"},
                                 {"x mvc", &ShapeQuality::torn_ratio, &OverPoses::most, "%.2f"}};

std::string cell(double value, const char* format) {
  return std::isnan(value) ? "-" : base::formatted(format, value);
}

std::string name_of(const Mode& mode) {
  const auto preset = pose::preset_of(mode.deformer);
  return (preset ? std::string(base::entry_of(*preset).word) + ": " : "") + pose::text(mode.deformer);
}

template <class Row>
void print_modes(const std::string& title, std::vector<std::string> columns, std::span<const Mode> modes,
                 const Row& row) {
  Table table{std::move(columns), {}};
  for (const Mode& mode : modes) {
    if (!mode.problem.empty()) continue;
    table.rows.push_back(row(mode));
    table.rows.back().insert(table.rows.back().begin(), name_of(mode));
  }
  print(title, table);
}

std::vector<std::string> own_cells(const Mode& mode) {
  std::vector<std::string> cells;
  for (const double d : mode.deviations) cells.push_back(d <= exactly ? "exact" : cell(d, "%.1e"));
  cells.insert(cells.end(), {cell(mode.leak, "%.1e"), cell(mode.frame_ms, mode.fused ? "%.3f" : "%.3f*"),
                             cell(mode.bind_ms, "%.1f")});
  return cells;
}

template <class Entries>
std::vector<std::string> columns_of(const Entries& entries) {
  std::vector<std::string> columns = {""};
  for (const auto& entry : entries) columns.emplace_back(entry.column);
  return columns;
}

void print_notes(const ModeComparison& compared, std::span<const NamedPose> poses) {
  std::printf("\ngap at rest: %.4f\n", compared.rest_gap);
  if (!compared.encloses) std::printf("note: the model is not closed, so volumes are not compared\n");
  if (compared.without_area)
    std::printf("note: %zu triangles of the model have no area at rest and are ignored\n",
                compared.without_area);
  for (const auto& warning : compared.warnings) std::printf("note: %s\n", warning.c_str());
  for (const Mode& mode : compared.modes) {
    const std::string name = name_of(mode);
    if (!mode.problem.empty())
      std::printf("note: %s was not measured: %s\n", name.c_str(), mode.problem.c_str());
    for (std::size_t p = 0; p < mode.qualities.size(); ++p) {
      if (const auto collapsed = mode.qualities[p].collapsed)
        std::printf("note: %s, %s: %zu triangles have collapsed\n", name.c_str(), poses[p].name.c_str(),
                    collapsed);
    }
  }
}

nlohmann::json to_json(const Mode& mode, std::span<const NamedPose> poses) {
  const pose::Deformer& deformer = mode.deformer;
  nlohmann::json json = {{"name", pose::text(deformer)},
                         {"weights", base::entry_of(deformer.weighting.weights).word},
                         {"blend", base::entry_of(deformer.blend).word}};
  if (const auto preset = pose::preset_of(deformer)) json["deformer"] = base::entry_of(*preset).word;
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
  for (std::size_t p = 0; p < poses.size(); ++p) {
    nlohmann::json pose = {{"pose", poses[p].name}, {"collapsed", mode.qualities[p].collapsed}};
    for (const Measure& m : measures) pose[m.key] = mode.qualities[p].*m.value;
    json["poses"].push_back(std::move(pose));
  }
  return json;
}

void print(const ModeComparison& compared, std::span<const NamedPose> poses) {
  print_modes("independent of the poses",
              {"", "moved", "rigid", "similar", "affine", "leak", "frame", "bind"}, compared.modes,
              own_cells);
  for (std::size_t p = 0; p < poses.size(); ++p)
    print_modes(poses[p].name, columns_of(measures), compared.modes, [&](const Mode& mode) {
      std::vector<std::string> cells;
      for (const Measure& m : measures) cells.push_back(cell(mode.qualities[p].*m.value, m.format));
      return cells;
    });
  if (poses.size() > 1)
    print_modes("all " + std::to_string(poses.size()) +
                    " poses; energy and bending x mvc: median and worst; gap: median; torn: worst",
                columns_of(summaries), compared.modes, [](const Mode& mode) {
                  std::vector<std::string> cells;
                  for (const Summary& s : summaries)
                    cells.push_back(cell(over_poses(mode, s.value).*s.over, s.format));
                  return cells;
                });
  print_notes(compared, poses);
}

}  // namespace

OverPoses over_poses(const Mode& mode, double ShapeQuality::*value) {
  std::vector<double> values;
  for (const ShapeQuality& q : mode.qualities) values.push_back(q.*value);
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return {std::nan(""), std::nan(""), std::nan("")};
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2], values.back()};
}

nlohmann::json to_json(const ModeComparison& compared, std::span<const NamedPose> poses) {
  nlohmann::json results = nlohmann::json::array();
  for (const Mode& mode : compared.modes) results.push_back(to_json(mode, poses));
  return {{"figure", "modes"}, {"rest_gap", compared.rest_gap}, {"results", results}};
}

void bench_modes(const ModelOptions& options, ModeSettings settings) {
  const document::Document opened = open_model(options.model, options.cage);
  const mesh::Surface& model = *opened.model().surface;
  std::vector<std::string> warnings = opened.cage()->warnings;
  const std::vector<NamedPose> poses = read_poses(options.poses, *opened.cage(), warnings);
  std::printf("modes: %s vertices, %zu cage triangles, method %s, kernel %s, %s\n%s",
              base::with_thousands(model.positions.size()).c_str(), opened.cage()->surface.triangles.size(),
              std::string(sym3::name(settings.method)).c_str(), std::string(sym3::kernel_name()).c_str(),
              processor_name().c_str(), modes_legend);
  for (const auto& warning : warnings) std::printf("note: %s\n", warning.c_str());
  base::Progress progress;
  settings.rounds = options.rounds;
  const ModeComparison compared = measure_modes(model, opened.cage(), poses, settings, progress);
  print(compared, poses);
  write_json(options.json, to_json(compared, poses));
}

}  // namespace viete::bench
