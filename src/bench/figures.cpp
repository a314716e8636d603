#include "bench/figures.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "files/shape_import.h"
#include "formats/read.h"
#include "shapes/spaces.h"

namespace viete::bench {

namespace {

using Points = std::vector<mesh::Point>;

class Between {
public:
  Between(const shapes::ShapeSpace& space, const Points& shape)
      : space_(space),
        shape_(shape),
        vector_(space.vector(shape, pool_)),
        anchors_(space_.logs().anchors_between(space_.logs().at_rest(), vector_)) {}

  Points linear(double share) const {
    Points line;
    for (std::size_t v = 0; v < shape_.size(); ++v)
      line.push_back((1 - share) * space_.rest()[v] + share * shape_[v]);
    return line;
  }
  Points in_log_space(double share) {
    const shapes::LogTerm term{&vector_, share};
    Points positions(shape_.size());
    space_.shape({&term, 1}, anchors_, pool_, work_, positions);
    return positions;
  }

private:
  base::WorkerPool pool_{1};
  const shapes::ShapeSpace& space_;
  const Points& shape_;
  shapes::LogVector vector_;
  shapes::AnchorWeights anchors_;
  shapes::LogSpace::Work work_;
};

std::vector<FrameTime> frames_of(const Figures& figures, bool in_own_cage, base::Progress& progress) {
  ModelOptions options;
  options.model = figures.files.model;
  if (in_own_cage) options.cage = figures.files.cage;
  options.faces = figures.sizes.faces;
  options.rounds = figures.sizes.rounds;
  return measure_frames(options, progress);
}

ModeComparison deformers_of(const Figures& figures, const document::Document& opened,
                            base::Progress& progress) {
  const ModeSettings settings{.rounds = figures.sizes.rounds, .named_only = true};
  return measure_modes(*opened.model().surface, opened.cage(), figures.poses, settings, progress);
}

}  // namespace

double edge_error(std::span<const mesh::Edge> edges, std::span<const mesh::Point> a,
                  std::span<const mesh::Point> b, std::span<const mesh::Point> shape) {
  const auto length = [](std::span<const mesh::Point> p, const mesh::Edge& e) {
    return mesh::norm(p[e[0]] - p[e[1]]);
  };
  double squares = 0;
  std::size_t count = 0;
  for (const mesh::Edge& e : edges) {
    const double expected = std::sqrt(length(a, e) * length(b, e));
    if (!(expected > 0)) continue;
    const double error = std::log(length(shape, e) / expected);
    squares += error * error;
    ++count;
  }
  return std::sqrt(squares / static_cast<double>(count));
}

ShapesOfModel read_shapes_of_model(const std::filesystem::path& rest,
                                   const std::vector<std::filesystem::path>& shapes) {
  ShapesOfModel model{formats::read(rest).surface, {}, {}};
  for (const auto& [name, shape] : files::read_shapes(shapes, model.rest).shapes) {
    model.names.push_back(name);
    model.shapes.push_back(*shape);
  }
  return model;
}

Halfway measure_halfway(const ShapesOfModel& model, base::Progress& progress) {
  constexpr std::size_t moments = 21;
  base::WorkerPool pool(1);
  const shapes::ShapeSpace space(model.rest, pool);
  const std::vector<mesh::Edge> edges = mesh::polygon_edges(model.rest);
  const RestModel rest(model.rest);
  const Points& from = rest.positions();
  Halfway halfway;
  for (std::size_t i = 0; i < model.shapes.size(); ++i) {
    const Points& to = model.shapes[i];
    const double smaller = std::min(1.0, rest.volume(to));
    const auto volume = [&](const Points& at) {
      return rest.encloses() ? rest.volume(at) / smaller : std::nan("");
    };
    const auto measured = [&](const Points& half) {
      return nlohmann::json{{"edges", edge_error(edges, from, to, half)}, {"volume", volume(half)}};
    };
    Between between(space, to);
    const Points in_log_space = between.in_log_space(0.5), linear = between.linear(0.5);
    nlohmann::json log = measured(in_log_space), line = measured(linear);
    for (std::size_t m = 0; m < moments; ++m) {
      const double share = static_cast<double>(m) / static_cast<double>(moments - 1);
      log["volumes"].push_back(volume(between.in_log_space(share)));
      line["volumes"].push_back(volume(between.linear(share)));
      progress.report((static_cast<double>(i) + share) / static_cast<double>(model.shapes.size()));
    }
    halfway.rows.push_back({{"name", model.names[i]}, {"log_space", log}, {"linear", line}});
    const auto volume_of = [&](std::size_t row) { return double(halfway.rows[row]["linear"]["volume"]); };
    if (volume_of(i) < volume_of(halfway.most_lost)) halfway.most_lost = i;
  }
  return halfway;
}

std::string name_of_shape(const nlohmann::json& row) {
  return without_prefix(row["name"], "shape_");
}

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
