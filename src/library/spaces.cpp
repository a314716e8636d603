#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/process.h"
#include "base/worker_pool.h"
#include "document/animation.h"
#include "library/arguments.h"
#include "shapes/example_posing.h"

namespace viete {

namespace library {

// Poses or shapes in the order of the motion, and their logarithms.
struct Sequence {
  std::vector<document::SharedPose> poses;
  std::vector<std::shared_ptr<const shapes::LogVector>> vectors;
  document::VectorCache known;
  std::optional<document::Animation> animation;

  document::WholePose at(double moment, bool linear) {
    const int last = static_cast<int>(poses.size()) - 1;
    check_range("at", moment, 0, last);
    if (animation) return animation->at(moment, linear);
    document::Timeline timeline;
    timeline.first = 0;
    timeline.last = last;
    timeline.repeat = document::Repeat::once;
    const auto easing = last == 1 ? document::Easing::constant_speed : document::Easing::smooth;
    for (int frame = 0; frame <= last; ++frame)
      timeline.keys.push_back({frame, poses[static_cast<std::size_t>(frame)], easing});
    return animation.emplace(timeline, known).at(moment, linear);
  }

  std::vector<shapes::LogTerm> sum(std::span<const double> weights) const {
    if (weights.size() != poses.size())
      throw base::Error(
          "weights",
          "there are " + std::to_string(weights.size()) + " for " + std::to_string(poses.size()) + " shapes",
          "pass one weight for each shape");
    std::vector<shapes::LogTerm> terms;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      check_range("weights", weights[i], -1000, 1000);
      if (weights[i] != 0) terms.push_back({vectors[i].get(), weights[i]});
    }
    return terms;
  }
  // If one weight is 1 and all others are 0, returns the pose with weight 1. Otherwise returns null.
  const document::WholePose* only(std::span<const double> weights,
                                  const std::vector<shapes::LogTerm>& sum) const {
    if (sum.size() != 1 || sum[0].factor != 1) return nullptr;
    return poses[static_cast<std::size_t>(std::ranges::find(weights, 1.0) - weights.begin())].get();
  }
};

}  // namespace library

namespace {

std::vector<Point3> sum_outside(const std::vector<mesh::Point>& sum) {
  library::check_finite(sum, "weights", "use weights nearer to 0");
  return library::outside(sum);
}

}  // namespace

struct ShapeSpace::Impl : library::Sequence {
  Impl(const Mesh& mesh, std::span<const std::vector<Point3>> all, int threads, base::Progress* progress)
      : rest(std::make_shared<const mesh::Surface>(library::deformable_surface_of(mesh, "the mesh at rest"))),
        pool(library::checked_threads(threads)) {
    if (all.empty()) throw base::Error("shapes", "the list is empty", "pass one or more");
    known.follow_model(rest);
    for (const auto& shape : all) {
      if (progress) progress->report(static_cast<double>(poses.size()) / static_cast<double>(all.size()));
      document::WholePose pose;
      pose.shape = std::make_shared<const std::vector<mesh::Point>>(
          library::deformable(library::inside(shape), rest->positions.size(), "a shape"));
      shapes::ShapeReport report;
      vectors.push_back(known.of(pose.shape, vectors.empty() ? nullptr : vectors.back(), pool, report));
      poses.push_back(std::make_shared<const document::WholePose>(std::move(pose)));
    }
  }
  const shapes::ShapeSpace& space() { return *known.shapes(pool); }

  std::shared_ptr<const mesh::Surface> rest;
  base::WorkerPool pool;
};

ShapeSpace::ShapeSpace(const Mesh& rest, std::span<const std::vector<Point3>> shapes, int threads,
                       const Watch& watch)
    : impl_(library::watched(watch, [&](base::Progress* progress) {
        return library::hidden<Impl>(rest, shapes, threads, progress);
      })) {}

std::vector<Point3> ShapeSpace::mix(std::span<const double> weights) const {
  const base::ForkDelay delay;
  const auto sum = impl_->sum(weights);
  if (const auto* only = impl_->only(weights, sum)) return library::outside(*only->shape);
  const shapes::ShapeSpace& space = impl_->space();
  if (sum.empty()) return library::outside(space.rest());
  const shapes::AnchorWeights anchors = space.logs().anchors_from(space.logs().at_rest(), sum);
  return sum_outside(*document::blended(space, sum, &anchors, impl_->pool));
}

std::vector<Point3> ShapeSpace::between(double at, bool linear) const {
  const base::ForkDelay delay;
  return library::outside(*impl_->at(at, linear).shape);
}

std::vector<Point3> ShapeSpace::pose(std::span<const std::uint32_t> vertices, std::span<const Point3> places,
                                     double firmness, double freedom, std::vector<double>* weights,
                                     const Watch& watch) const {
  constexpr int most_steps = 200;
  const auto targets = library::deformable(library::inside(places), vertices.size(), "the places");
  if (!(firmness > 0))
    throw base::Error("firmness", "the value is out of range", "choose a value above 0, for example 0.3");
  library::check_range("freedom", freedom, 0, 1);
  if (vertices.empty()) throw base::Error("vertices", "the list is empty", "pass one or more");
  std::vector<char> pinned(impl_->rest->positions.size(), 0);
  std::vector<shapes::PosingPin> pins;
  for (const std::uint32_t v : vertices) {
    if (v >= impl_->rest->positions.size())
      throw base::Error("vertices", "there is no vertex " + std::to_string(v), "use vertex indices from 0");
    if (std::exchange(pinned[v], 1))
      throw base::Error("vertices", "vertex " + std::to_string(v) + " is given twice",
                        "pass each vertex once");
    pins.push_back({v, firmness > 1e9 ? shapes::holding : firmness});
  }
  std::vector<const shapes::LogVector*> examples;
  for (const auto& vector : impl_->vectors) examples.push_back(vector.get());
  shapes::ExamplePosing posing(impl_->space(), std::move(examples), impl_->pool);
  library::watched(watch, [&](base::Progress* progress) {
    posing.set_pins(std::move(pins));
    posing.solve(targets, {.freedom = freedom}, most_steps, progress);
  });
  if (weights) *weights = posing.weights();
  return library::outside(posing.positions());
}

struct PoseSpace::Impl : library::Sequence {
  Impl(const Mesh& mesh, std::span<const std::vector<Point3>> all)
      : cage(std::make_shared<const pose::Cage>(
            pose::make_cage(library::deformable_surface_of(mesh, "the cage")))) {
    if (all.empty()) throw base::Error("poses", "the list is empty", "pass one or more");
    known.follow(cage);
    for (const auto& positions : all) {
      document::WholePose pose;
      pose.cage.positions =
          library::deformable(library::inside(positions), cage->surface.positions.size(), "a pose");
      poses.push_back(std::make_shared<const document::WholePose>(std::move(pose)));
      vectors.push_back(known.of(poses.back()));
    }
  }

  std::shared_ptr<const pose::Cage> cage;
};

PoseSpace::PoseSpace(const Mesh& cage, std::span<const std::vector<Point3>> poses)
    : impl_(library::hidden<Impl>(cage, poses)) {}

std::vector<Point3> PoseSpace::mix(std::span<const double> weights) const {
  const base::ForkDelay delay;
  const auto sum = impl_->sum(weights);
  if (const auto* only = impl_->only(weights, sum)) return library::outside(only->cage.positions);
  if (sum.empty()) return library::outside(impl_->cage->surface.positions);
  const shapes::PoseSpace& space = *impl_->known.space();
  const shapes::LogSpace& logs = space.logs();
  return sum_outside(space.pose(sum, logs.anchors_from(logs.at_rest(), sum)).positions);
}

std::vector<Point3> PoseSpace::between(double at, bool linear) const {
  const base::ForkDelay delay;
  return library::outside(impl_->at(at, linear).cage.positions);
}

}  // namespace viete
