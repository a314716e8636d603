#include "bench/figures.h"

#include <functional>

#include "bench/models.h"

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

ModeComparison deformers_of(const Figures& figures, const document::Document& opened, base::Progress& progress) {
  const ModeSettings settings{.rounds = figures.sizes.rounds, .named_only = true};
  return measure_modes(*opened.model().surface, opened.cage(), figures.poses, settings, progress);
}

}  // namespace

ReportSizes quick_sizes() {
  return {400'000, 256, {50, 300}, 3};
}

Figures measure_figures(const ReportFiles& files, const ReportSizes& sizes, base::Progress& progress) {
  Figures figures{sizes, files, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  const document::Document opened = open_model(files.model, files.cage);
  std::vector<std::string> warnings;
  figures.poses = read_poses(files.poses, *opened.cage(), warnings);
  if (figures.poses.empty()) figures.poses.push_back({"made", moderate_pose(*opened.cage())});
  const ShapesOfModel shapes = read_shapes_of_model(files.rest, files.shapes);
  const struct {
    double seconds;  // approximate time with default sizes
    std::function<void()> measure;
  } works[] = {{10, [&] { figures.eigen = measure_eigen(sizes.matrices, progress); }},
               {25, [&] { figures.exp = measure_exp(sizes.matrices, false, progress); }},
               {18, [&] { figures.exp_in_float = measure_exp(sizes.matrices, true, progress); }},
               {25, [&] { figures.accuracy = measure_accuracy(sizes.samples, false, progress); }},
               {25, [&] { figures.accuracy_in_float = measure_accuracy(sizes.samples, true, progress); }},
               {7, [&] { figures.deformation = frames_of(figures, true, progress); }},
               {28, [&] { figures.frames = frames_of(figures, false, progress); }},
               {25, [&] { figures.deformers = deformers_of(figures, opened, progress); }},
               {5, [&] { figures.shapes = measure_halfway(shapes, progress); }}};
  double all = 0, done = 0;
  for (const auto& work : works) all += work.seconds;
  for (const auto& work : works) {
    const base::ProgressPart part(&progress, done / all, (done + work.seconds) / all);
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
          {"deformers", to_json(f.deformers, f.poses)},
          {"shapes", f.shapes.rows}};
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
