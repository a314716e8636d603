#include "bench/figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "bench/exp.h"
#include "bench/frame.h"
#include "bench/halfway.h"
#include "bench/models.h"
#include "bench/modes.h"
#include "bench/modes_table.h"
#include "mesh/normals.h"

namespace viete::bench {

namespace {

std::vector<FrameTime> frames_of(const Figures& figures, bool in_own_cage, base::Progress& progress) {
  ModelOptions options;
  options.model = figures.files.model;
  if (in_own_cage) options.cage = figures.files.cage;
  options.faces = figures.sizes.faces;
  options.rounds = figures.sizes.rounds;
  return measure_frames(options, progress);
}

ModeComparison ways_of(const Figures& figures, const scene::Document& opened, base::Progress& progress) {
  const ModeSettings settings{.rounds = figures.sizes.rounds, .named_only = true};
  return measure_modes(*opened.model.surface, opened.cage, figures.poses, settings, progress);
}

// View from above and from the side, with back faces removed.
ShapePicture picture_of(std::string name, const mesh::Surface& rest,
                        const std::vector<mesh::Point>& positions) {
  constexpr std::size_t most_dots = 3000;
  constexpr double aside = 0.5, above = 0.6;  // radians
  const mesh::Point right{std::cos(aside), 0, -std::sin(aside)},
      toward{std::sin(aside) * std::cos(above), std::sin(above), std::cos(aside) * std::cos(above)};
  const mesh::Point up = mesh::cross(toward, right);
  const auto around = mesh::vertex_triangles(positions.size(), rest.triangles);
  std::vector<mesh::Point> normals(positions.size());
  mesh::vertex_normals(positions, rest.triangles, around, 0, positions.size(), normals);
  const mesh::Point middle = mesh::bounds(positions).center();
  const double diagonal = mesh::bounds(rest.positions).diagonal();
  ShapePicture picture{std::move(name), {}};
  for (std::size_t v = 0; v < positions.size();
       v += std::max<std::size_t>(1, positions.size() / (2 * most_dots))) {
    const mesh::Point p = positions[v] - middle;
    if (mesh::dot(normals[v], toward) > 0)
      picture.dots.push_back({mesh::dot(p, right) / diagonal, mesh::dot(p, up) / diagonal});
  }
  return picture;
}

void measure_shapes(Figures& figures, const ShapesOfModel& model, base::Progress& progress) {
  Halfway halfway = measure_halfway(model, progress);
  figures.shapes = std::move(halfway.rows);
  const nlohmann::json* most = most_lost(figures.shapes);
  if (!most) return;
  const auto i = static_cast<std::size_t>(most - &figures.shapes[0]);
  figures.pictures = {picture_of("at rest", model.rest, model.rest.positions),
                      picture_of("halfway, linear", model.rest, halfway.shapes[i].straight),
                      picture_of("halfway, log space", model.rest, halfway.shapes[i].in_log_space),
                      picture_of(name_of_shape(*most), model.rest, model.shapes[i])};
}

}  // namespace

ReportSizes quick_sizes() {
  return {400'000, 256, {50, 300}, 3};
}

Figures measure_figures(const ReportFiles& files, const ReportSizes& sizes, base::Progress& progress) {
  Figures figures{sizes, files, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  // Checks files first.
  const scene::Document opened = open_model(files.model, files.cage);
  std::vector<std::string> warnings;
  figures.poses = read_poses(files.poses, *opened.cage, warnings);
  if (figures.poses.empty()) figures.poses.push_back({"made", moderate_pose(*opened.cage)});
  const ShapesOfModel shapes = read_shapes_of_model(files.rest, files.shapes);
  const struct {
    double seconds;  // approximate, of all matrices
    std::function<void()> measure;
  } works[] = {{10, [&] { figures.eigen = measure_eigen(sizes.matrices, progress); }},
               {25, [&] { figures.exp = measure_exp(sizes.matrices, false, progress); }},
               {18, [&] { figures.exp_in_float = measure_exp(sizes.matrices, true, progress); }},
               {25, [&] { figures.accuracy = measure_accuracy(sizes.samples, false, progress); }},
               {25, [&] { figures.accuracy_in_float = measure_accuracy(sizes.samples, true, progress); }},
               {7, [&] { figures.deformation = frames_of(figures, true, progress); }},
               {28, [&] { figures.frames = frames_of(figures, false, progress); }},
               {25, [&] { figures.ways = ways_of(figures, opened, progress); }},
               {5, [&] { measure_shapes(figures, shapes, progress); }}};
  double all = 0, done = 0;
  for (const auto& work : works) all += work.seconds;
  for (const auto& work : works) {
    progress.part(done / all, (done + work.seconds) / all);
    done += work.seconds;
    work.measure();
  }
  return figures;
}

nlohmann::json to_json(const Figures& f) {
  return {{"eigenvalues", to_json(f.eigen)},
          {"exponentials", {{"double", to_json(f.exp)}, {"float", to_json(f.exp_in_float)}}},
          {"accuracy", {{"double", to_json(f.accuracy)}, {"float", to_json(f.accuracy_in_float)}}},
          {"deformation", to_json(f.deformation)},
          {"frames", to_json(f.frames)},
          {"ways", to_json(f.ways, f.poses)},
          {"shapes", f.shapes}};
}

double percent_less(double time, double than) {
  return 100 * (1 - time / than);
}

const FrameTime* staged_frame(std::span<const FrameTime> times, sym3::Method method) {
  return times.empty() ? nullptr
                       : frame_of(times, "staged, " + std::string(sym3::name(method)), times.front().faces);
}

double worst_of_clusters(const std::vector<AccuracyTable>& tables, const std::string& method) {
  const auto methods = exp_methods();
  const auto at = std::ranges::find(methods, method, [](const ExpMethod& m) { return std::string(m.name); });
  double worst = 0;
  for (const AccuracyTable& table : tables) {
    if (table.by != "gap") continue;
    for (const auto& row : table.rows)
      worst = std::max(worst, row.cells[static_cast<std::size_t>(at - methods.begin())].worst);
  }
  return worst;
}

std::string lost_volume(const nlohmann::json& way) {
  const double lost = 100 * (1 - double(way["volume"]));
  return lost < 0.5 ? "nothing" : percent(lost);
}

std::string shell_word(const std::filesystem::path& path) {
  const std::string text = path.string();
  const bool plain = text.find_first_of(" '\"$&;()<>|*?[]#~`\\!") == std::string::npos;
  if (plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace viete::bench
