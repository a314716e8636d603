#include "bench/published_shapes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/median.h"
#include "base/numbered_files.h"
#include "base/worker_pool.h"
#include "bench/rest_model.h"
#include "bench/shape_errors.h"
#include "deform/example_posing.h"
#include "deform/shape_space.h"
#include "mesh/formats/read.h"
#include "scene/document/animation.h"
#include "scene/files/shape_import.h"

namespace viete::bench {

namespace {

using Points = std::vector<mesh::Point>;

/// What lies between rest and a shape.
class Between {
public:
  Between(const deform::ShapeSpace& space, const Points& shape)
      : logs_(space.logs()),
        shape_(shape),
        vector_(space.vector(shape, pool_)),
        held_(logs_.held_between(logs_.at_rest(), vector_)) {}

  Points straight(double share) const {
    Points line;
    for (std::size_t v = 0; v < shape_.size(); ++v)
      line.push_back((1 - share) * logs_.rest()[v] + share * shape_[v]);
    return line;
  }
  Points in_log_space(double share) {
    const deform::LogTerm term{&vector_, share};
    Points positions(shape_.size());
    logs_.shape({&term, 1}, held_, pool_, work_, positions);
    return positions;
  }

private:
  base::WorkerPool pool_{1};
  const deform::LogSpace& logs_;
  const Points& shape_;
  deform::LogVector vector_;
  deform::Held held_;
  deform::LogSpace::Work work_;
};

/// The gallop, frame by frame; it is closed.
class Gallop {
public:
  static constexpr int frames = 24;

  explicit Gallop(const std::filesystem::path& folder)
      : horse_(read_shapes_of_model(folder / "horse/rest.obj", {folder / "horse/gallop_##.obj"})),
        errors_(horse_.rest) {
    if (horse_.shapes.size() != frames)
      throw base::Error((folder / "horse").string(),
                        "a gallop has 24 frames, and there are " + std::to_string(horse_.shapes.size()));
  }

  const mesh::Surface& rest() const { return horse_.rest; }
  /// From 1 on.
  const Points& frame(int i) const { return horse_.shapes[static_cast<std::size_t>(i - 1)]; }

  /// Sums of distances and of edges' errors.
  struct Error {
    double distance = 0, edges = 0;
    int count = 0;

    double mean_distance() const { return distance / count; }
    double mean_edges() const { return edges / count; }
    nlohmann::json json() const { return {{"distance", mean_distance()}, {"edges", mean_edges()}}; }
  };
  void add(int i, std::span<const mesh::Point> positions, Error& error) const {
    error.distance += errors_.distance(frame(i), positions);
    error.edges += errors_.edges(frame(i), frame(i), positions).share_95;
    ++error.count;
  }

  /// Of the frames that are left out where every `kept`-th is a key.
  Error filled_in(int kept) const;

private:
  ShapesOfModel horse_;
  ShapeErrors errors_;
};

Gallop::Error Gallop::filled_in(int kept) const {
  scene::Timeline timeline;
  timeline.last = 1 + frames;
  timeline.repeat = scene::Repeat::loop;
  for (int i = 1; i <= 1 + frames; i += kept) {
    scene::WholePose pose;
    pose.shape = i > frames ? timeline.keys.front().pose->shape : std::make_shared<const Points>(frame(i));
    timeline.keys.push_back({i, std::make_shared<const scene::WholePose>(std::move(pose))});
  }
  scene::KnownVectors vectors;
  vectors.follow_model(std::make_shared<const mesh::Surface>(horse_.rest));
  const scene::Animation animation(timeline, vectors);
  Error error;
  for (int i = 1; i <= frames; ++i)
    if ((i - 1) % kept != 0) add(i, *animation.at(i).shape, error);
  return error;
}

/// Seven vertices of frames that are none of the examples, and what makes the others of them.
class GivenVertices {
public:
  explicit GivenVertices(const Gallop& gallop) : gallop_(gallop), given_(far_vertices(rest(), 7)) {
    const deform::ShapeSpace space(gallop.rest(), pool_);
    std::vector<deform::LogVector> vectors;
    for (const int i : examples) vectors.push_back(space.vector(gallop.frame(i), pool_));
    std::vector<const deform::LogVector*> known;
    for (const auto& vector : vectors) known.push_back(&vector);
    std::vector<deform::PosingPin> pins;
    for (const auto v : given_) pins.push_back({v, std::numeric_limits<double>::infinity()});
    for (const int i : frames) {
      deform::ExamplePosing posing(space, known, pool_);
      posing.set_pins(pins);
      Points targets;
      for (const auto v : given_) targets.push_back(gallop.frame(i)[v]);
      posing.solve(targets, {}, most_steps);
      gallop.add(i, posing.positions(), posed);
      gallop.add(i, blended(targets), linear);
    }
  }

  Gallop::Error posed, linear;

private:
  static constexpr std::array examples{1, 3, 5, 7, 9, 11};
  static constexpr std::array frames{2, 6, 10};
  static constexpr int most_steps = 60;

  const Points& rest() const { return gallop_.rest().positions; }

  /// Rest, shares of the examples' straight ways, and a translation, by least squares.
  Points blended(const Points& targets) const {
    const auto known = static_cast<Eigen::Index>(examples.size()),
               count = static_cast<Eigen::Index>(given_.size());
    Eigen::MatrixXd ways(3 * count, known + 3);
    Eigen::VectorXd off(3 * count);
    for (Eigen::Index row = 0; row < 3 * count; ++row) {
      const auto k = static_cast<std::size_t>(row / 3), j = static_cast<std::size_t>(row % 3);
      const auto v = given_[k];
      off[row] = targets[k][j] - rest()[v][j];
      for (Eigen::Index e = 0; e < known; ++e)
        ways(row, e) = gallop_.frame(examples[static_cast<std::size_t>(e)])[v][j] - rest()[v][j];
      for (Eigen::Index axis = 0; axis < 3; ++axis) ways(row, known + axis) = axis == row % 3;
    }
    const Eigen::VectorXd shares = ways.colPivHouseholderQr().solve(off);
    Points positions = rest();
    for (std::size_t v = 0; v < positions.size(); ++v) {
      for (std::size_t e = 0; e < examples.size(); ++e)
        positions[v] = positions[v] + shares[Eigen::Index(e)] * (gallop_.frame(examples[e])[v] - rest()[v]);
      positions[v] = positions[v] + mesh::Vec3{shares[known], shares[known + 1], shares[known + 2]};
    }
    return positions;
  }

  const Gallop& gallop_;
  std::vector<std::uint32_t> given_;
  base::WorkerPool pool_{1};
};

}  // namespace

ShapesOfModel read_shapes_of_model(const std::filesystem::path& rest,
                                   const std::vector<std::filesystem::path>& shapes) {
  ShapesOfModel model{mesh::read(rest).surface, {}, {}};
  for (const auto& [name, shape] : scene::read_shapes(shapes, model.rest).shapes)
    model.names.push_back(name), model.shapes.push_back(*shape);
  return model;
}

ShapesOfModel read_lion(const std::filesystem::path& folder) {
  return read_shapes_of_model(folder / "lion/rest.obj", {folder / "lion/pose_##.obj"});
}

nlohmann::json measure_halfway(const ShapesOfModel& model, base::Progress& progress, std::size_t moments) {
  base::WorkerPool pool(1);
  const deform::ShapeSpace space(model.rest, pool);
  const ShapeErrors errors(model.rest);
  const RestModel rest(model.rest);
  const Points& from = rest.positions();
  nlohmann::json rows = nlohmann::json::array();
  for (std::size_t i = 0; i < model.shapes.size(); ++i) {
    const Points& to = model.shapes[i];
    const double smaller = std::min(1.0, rest.volume(to));
    const auto volume = [&](const Points& at) {
      return rest.encloses() ? rest.volume(at) / smaller : std::nan("");
    };
    const auto measured = [&](const Points& half) {
      const EdgeErrors e = errors.edges(from, to, half);
      return nlohmann::json{
          {"edges", e.root_mean_square}, {"edges_99", e.share_99}, {"volume", volume(half)}};
    };
    Between between(space, to);
    nlohmann::json log = measured(between.in_log_space(0.5)), line = measured(between.straight(0.5));
    for (std::size_t m = 0; m < moments; ++m) {
      const double share = static_cast<double>(m) / static_cast<double>(moments - 1);
      log["volumes"].push_back(volume(between.in_log_space(share)));
      line["volumes"].push_back(volume(between.straight(share)));
      progress.report((static_cast<double>(i) + share) / static_cast<double>(model.shapes.size()));
    }
    rows.push_back({{"name", model.names[i]}, {"log_space", log}, {"straight", line}});
  }
  return rows;
}

HalfwayShapes halfway_to(const ShapesOfModel& model, std::size_t shape) {
  base::WorkerPool pool(1);
  const deform::ShapeSpace space(model.rest, pool);
  Between between(space, model.shapes[shape]);
  return {between.straight(0.5), between.in_log_space(0.5)};
}

void print_halfway(const nlohmann::json& halfway) {
  std::printf("  %-20s %32s %32s\n", "halfway from rest", "log space: edges, 99 %, volume",
              "straight: edges, 99 %, volume");
  for (const auto& row : halfway) {
    std::printf("  %-20s", std::string(row["name"]).c_str());
    for (const auto& m : {row["log_space"], row["straight"]})
      std::printf("  %13.3f %7.3f %9.3f", double(m["edges"]), double(m["edges_99"]), double(m["volume"]));
    std::printf("\n");
  }
}

const nlohmann::json* most_lost(const nlohmann::json& halfway) {
  const nlohmann::json* most = nullptr;
  for (const auto& row : halfway) {
    if (!most || double(row["straight"]["volume"]) < double((*most)["straight"]["volume"])) most = &row;
  }
  return most;
}

std::string name_of_shape(const nlohmann::json& row) {
  const std::string name = row["name"], prefix = "shape_";
  return name.starts_with(prefix) ? name.substr(prefix.size()) : name;
}

void check_halfway(const nlohmann::json& halfway, Bars& bars) {
  double edges = 0, edges_99 = 0, volume = std::numeric_limits<double>::infinity();
  std::vector<double> logs, lines;
  for (const auto& row : halfway) {
    const auto& log = row["log_space"];
    logs.push_back(log["edges"]), lines.push_back(row["straight"]["edges"]);
    edges = std::max(edges, logs.back());
    edges_99 = std::max(edges_99, double(log["edges_99"]));
    volume = std::min(volume, double(log["volume"]));
  }
  bars.check("lion, halfway: edges, root mean square, worst pose, %", 100 * edges, 5, false);
  bars.check("lion, halfway: 99 % of edges, worst pose, %", 100 * edges_99, 20, false);
  bars.check("lion, halfway: volume over the smaller end's, worst pose", volume, 0.99, true);
  bars.check("lion, halfway: straight lines' edges over ours, medians",
             base::median(lines) / base::median(logs), 6, true);
}

nlohmann::json check_gallop(const std::filesystem::path& folder, Bars& bars) {
  const Gallop gallop(folder);
  const auto second = gallop.filled_in(2), third = gallop.filled_in(3);
  const GivenVertices given(gallop);
  const auto check = [&](const char* what, const Gallop::Error& error, double distance, double edges) {
    bars.check(std::string(what) + ": distance, % of diagonal", 100 * error.mean_distance(), distance, false);
    bars.check(std::string(what) + ": 95 % of edges, %", 100 * error.mean_edges(), edges, false);
  };
  check("gallop, every 2nd kept", second, 0.65, 7.3);
  check("gallop, every 3rd kept", third, 1.06, 11.7);
  check("gallop, by 6 examples, 7 vertices", given.posed, 0.64, 7.4);
  bars.check("the same: distance over that of linear blend shapes",
             given.posed.mean_distance() / given.linear.mean_distance(), 0.57, false);
  return {{"every_second", second.json()},
          {"every_third", third.json()},
          {"by_examples", given.posed.json()},
          {"linear_blend_shapes", given.linear.json()}};
}

}  // namespace viete::bench
