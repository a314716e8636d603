#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/process.h"
#include "base/worker_pool.h"
#include "deform/example_posing.h"
#include "library/surfaces.h"
#include "library/watched.h"
#include "library/words.h"
#include "scene/document/animation.h"
#include "scene/document/shape_mix.h"

namespace viete {

namespace {

// One key per frame, from frame 0.
scene::Timeline timeline_of(std::vector<scene::WholePose> poses, bool straight) {
  scene::Timeline timeline;
  timeline.first = 0, timeline.last = static_cast<int>(poses.size()) - 1;
  timeline.straight = straight;
  timeline.repeat = scene::Repeat::once;
  const auto easing = poses.size() == 2 ? scene::Easing::linear : scene::Easing::smooth;
  for (std::size_t i = 0; i < poses.size(); ++i)
    timeline.keys.push_back(
        {static_cast<int>(i), std::make_shared<const scene::WholePose>(std::move(poses[i])), easing});
  return timeline;
}

void check_moment(double at, std::size_t count) {
  if (!(at >= 0 && at <= static_cast<double>(count) - 1))
    throw base::Error("at", "the value is out of range",
                      "0 is the first shape, " + std::to_string(count - 1) + " the last");
}

void check_number(std::size_t number, std::size_t count) {
  if (number >= count)
    throw base::Error("shapes", "there is no shape " + std::to_string(number), "indices start at 0");
}

void check_weights(std::span<const double> weights, std::size_t count) {
  if (weights.size() != count)
    throw base::Error(
        "weights",
        "there are " + std::to_string(weights.size()) + " for " + std::to_string(count) + " shapes",
        "pass one per shape");
  for (const double w : weights)
    if (!(std::abs(w) <= 1000))
      throw base::Error("weights", "a weight is not finite, or beyond 1000", "choose -1000 to 1000");
}

std::vector<Point3> sum_outside(const std::vector<mesh::Point>& sum) {
  library::check_finite(sum, "weights", "use weights nearer to 0");
  return library::outside(sum);
}

// Blends the entries whose weight is not 0. A single entry of weight 1 is returned bit for bit.
template <class Whole, class Make>
auto sum_of(std::span<const double> weights, const std::vector<deform::LogVector>& vectors,
            const Whole& whole, const Make& make) {
  std::vector<deform::LogTerm> sum;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] != 0) sum.push_back({&vectors[i], weights[i]});
  if (sum.size() == 1 && sum[0].factor == 1)
    return whole(static_cast<std::size_t>(sum[0].vector - vectors.data()));
  return make(sum);
}

}  // namespace

struct ShapeSpace::Impl {
  Impl(const Mesh& mesh, std::span<const std::vector<Point3>> all, int threads, base::Progress* progress)
      : rest(std::make_shared<const mesh::Surface>(library::deformable_surface_of(mesh, "the mesh at rest"))),
        pool(library::checked_threads(threads)),
        space(*rest, pool, progress) {
    if (all.empty()) throw base::Error("shapes", "the list is empty", "pass one or more");
    for (const auto& shape : all) {
      if (progress) progress->report(static_cast<double>(shapes.size()) / static_cast<double>(all.size()));
      const std::vector<mesh::Point> positions = library::inside(shape);
      library::check_points(positions, rest->positions.size(), "a shape");
      library::check_deformable(positions, 0, "a shape");
      const deform::LogVector* before = vectors.empty() ? nullptr : &vectors.back();
      deform::LogVector vector = space.vector(positions, pool, before);
      vectors.push_back(std::move(vector));
      shapes.push_back(std::make_shared<const std::vector<mesh::Point>>(positions));
    }
  }

  const scene::Animation& way() {
    if (animation) return *animation;
    std::vector<scene::WholePose> poses(shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) poses[i].shape = shapes[i];
    known.follow_model(rest);
    animation.emplace(timeline_of(std::move(poses), false), known);
    return *animation;
  }

  std::shared_ptr<const mesh::Surface> rest;
  base::WorkerPool pool;
  deform::ShapeSpace space;
  std::vector<scene::SharedShape> shapes;
  std::vector<deform::LogVector> vectors;
  scene::VectorCache known;
  std::optional<scene::Animation> animation;
};

ShapeSpace::ShapeSpace(const Mesh& rest, std::span<const std::vector<Point3>> shapes, int threads,
                       const Watch& watch)
    : impl_(library::watched(watch, [&](base::Progress* progress) {
        return std::make_unique<Impl>(rest, shapes, threads, progress);
      })) {}
ShapeSpace::~ShapeSpace() = default;
ShapeSpace::ShapeSpace(ShapeSpace&&) noexcept = default;
ShapeSpace& ShapeSpace::operator=(ShapeSpace&&) noexcept = default;

std::size_t ShapeSpace::shape_count() const {
  return impl_->shapes.size();
}

std::vector<std::array<double, 9>> ShapeSpace::vector(std::size_t shape) const {
  check_number(shape, impl_->vectors.size());
  return impl_->vectors[shape].logs;
}

std::vector<Point3> ShapeSpace::mix(std::span<const double> weights) const {
  const base::ForkDelay delay;
  check_weights(weights, impl_->shapes.size());
  const deform::LogSpace& logs = impl_->space.logs();
  return sum_outside(sum_of(
      weights, impl_->vectors, [&](std::size_t i) { return *impl_->shapes[i]; },
      [&](const std::vector<deform::LogTerm>& sum) {
        if (sum.empty()) return logs.rest();
        const deform::Held held = logs.held_from(logs.at_rest(), sum);
        return *scene::blended(logs, sum, &held, impl_->pool);
      }));
}

std::vector<Point3> ShapeSpace::between(double at, bool straight) const {
  const base::ForkDelay delay;
  check_moment(at, impl_->shapes.size());
  return library::outside(*impl_->way().at(at, straight).shape);
}

std::vector<Point3> ShapeSpace::pose(std::span<const std::uint32_t> vertices, std::span<const Point3> places,
                                     double firmness, double freedom, std::vector<double>* weights,
                                     const Watch& watch) const {
  constexpr int most_steps = 200;
  const std::vector<mesh::Point> targets = library::inside(places);
  library::check_points(targets, vertices.size(), "the places");
  library::check_deformable(targets, 0, "the places");
  if (!(firmness > 0))
    throw base::Error("firmness", "it must be above 0", "0.3 pulls as strongly as neighbours do");
  if (!(freedom >= 0 && freedom <= 1)) throw base::Error("freedom", "it must be 0 to 1", "choose 0 to 1");
  if (vertices.empty()) throw base::Error("vertices", "the list is empty", "pass one or more");
  std::vector<char> pinned(impl_->rest->positions.size(), 0);
  std::vector<deform::PosingPin> pins;
  for (const std::uint32_t v : vertices) {
    if (v >= impl_->rest->positions.size())
      throw base::Error("vertices", "there is no vertex " + std::to_string(v), "indices start at 0");
    if (std::exchange(pinned[v], 1))
      throw base::Error("vertices", "vertex " + std::to_string(v) + " is given twice",
                        "pass each vertex once");
    pins.push_back({v, firmness > 1e9 ? deform::holding : firmness});
  }
  std::vector<const deform::LogVector*> examples;
  for (const auto& vector : impl_->vectors) examples.push_back(&vector);
  deform::ExamplePosing posing(impl_->space, std::move(examples), impl_->pool);
  library::watched(watch, [&](base::Progress* progress) {
    posing.set_pins(std::move(pins));
    posing.solve(targets, {.freedom = freedom}, most_steps, progress);
  });
  if (weights) *weights = posing.weights();
  return library::outside(posing.positions());
}

struct PoseSpace::Impl {
  Impl(const Mesh& mesh, std::span<const std::vector<Point3>> all)
      : cage(std::make_shared<const deform::Cage>(
            deform::make_cage(library::deformable_surface_of(mesh, "the cage")))),
        space(cage) {
    if (all.empty()) throw base::Error("poses", "the list is empty", "pass one or more");
    for (const auto& pose : all) {
      const std::vector<mesh::Point> positions = library::inside(pose);
      library::check_points(positions, cage->surface.positions.size(), "a pose");
      library::check_deformable(positions, 0, "a pose");
      vectors.push_back(space.vector({positions, {}}));
      poses.push_back(positions);
    }
  }

  const scene::Animation& way() {
    if (animation) return *animation;
    std::vector<scene::WholePose> keys(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) keys[i].cage.positions = poses[i];
    known.follow(cage);
    animation.emplace(timeline_of(std::move(keys), false), known);
    return *animation;
  }

  std::shared_ptr<const deform::Cage> cage;
  deform::PoseSpace space;
  std::vector<std::vector<mesh::Point>> poses;
  std::vector<deform::LogVector> vectors;
  scene::VectorCache known;
  std::optional<scene::Animation> animation;
};

PoseSpace::PoseSpace(const Mesh& cage, std::span<const std::vector<Point3>> poses)
    : impl_(std::make_unique<Impl>(cage, poses)) {}
PoseSpace::~PoseSpace() = default;
PoseSpace::PoseSpace(PoseSpace&&) noexcept = default;
PoseSpace& PoseSpace::operator=(PoseSpace&&) noexcept = default;

std::size_t PoseSpace::pose_count() const {
  return impl_->poses.size();
}

std::vector<std::array<double, 9>> PoseSpace::vector(std::size_t pose) const {
  check_number(pose, impl_->vectors.size());
  return impl_->vectors[pose].logs;
}

std::vector<Point3> PoseSpace::mix(std::span<const double> weights) const {
  const base::ForkDelay delay;
  check_weights(weights, impl_->poses.size());
  const deform::LogSpace& logs = impl_->space.logs();
  return sum_outside(sum_of(
      weights, impl_->vectors, [&](std::size_t i) { return impl_->poses[i]; },
      [&](const std::vector<deform::LogTerm>& sum) {
        if (sum.empty()) return impl_->cage->surface.positions;
        return impl_->space.pose(sum, logs.held_from(logs.at_rest(), sum)).positions;
      }));
}

std::vector<Point3> PoseSpace::between(double at, bool straight) const {
  const base::ForkDelay delay;
  check_moment(at, impl_->poses.size());
  return library::outside(impl_->way().at(at, straight).cage.positions);
}

}  // namespace viete
