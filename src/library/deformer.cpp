#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/process.h"
#include "base/worker_pool.h"
#include "deform/exact.h"
#include "deform/frame_deformer.h"
#include "files/export.h"
#include "library/arguments.h"
#include "mesh/normals.h"
#include "pose/deformer.h"
#include "weights/bind.h"
#include "weights/binding.h"

namespace viete {

namespace {

template <class Value>
void take(const std::string& name, const char* what, std::optional<Value>& value) {
  if (!name.empty()) value = library::named<Value>(name, what);
}

void check_turns(const std::vector<Point3>* turns) {
  if (!turns) return;
  for (const Point3& turn : *turns)
    for (const double x : turn)
      if (!(std::abs(x) <= 1e6))
        throw base::Error("turns", "a rotation vector is not finite or above 1e6",
                          "pass the value that the previous call has returned");
}

void check_sizes(std::size_t positions, std::size_t normals, std::size_t vertices) {
  if (positions != 3 * vertices || (normals != 0 && normals != positions))
    throw base::Error("results", "the size of positions or normals is wrong",
                      "pass three numbers for each of " + std::to_string(vertices) + " vertices");
}

void write(std::span<const mesh::Point> points, std::span<double> to) {
  for (std::size_t v = 0; v < points.size(); ++v)
    std::ranges::copy(points[v], to.begin() + static_cast<std::ptrdiff_t>(3 * v));
}

}  // namespace

pose::Deformer library::deformer_of(const Blending& b) {
  pose::AskedDeformer asked;
  take(b.deformer, "deformer", asked.preset);
  take(b.weights, "weights", asked.choice.weights);
  take(b.blend, "blend", asked.choice.blend);
  asked.radius = b.radius;
  asked.rotation = b.rotation;
  asked.stretch = b.stretch;
  asked.arap = b.arap;
  asked.iterations = b.iterations;
  asked.attach = b.attach;
  asked.hold = b.hold;
  for (const pose::NumberEntry& number : pose::all_numbers())
    if (const auto& value = asked.*number.asked)
      check_range(number.word.data(), *value, number.least, number.largest);
  if (b.iterations) check_range("iterations", *b.iterations, 1, pose::most_iterations);
  return pose::deformer_of(asked, pose::default_deformer());
}

sym3::Method library::method_of(const std::string& name) {
  if (const auto method = sym3::method_from_name(name)) return *method;
  throw base::Error("method", "unknown name " + name, "choose diag, sd, improved_sd or fast");
}

std::string library::settings_text() {
  std::string text;
  const auto add = [&](std::string_view name, std::string_view about) {
    text += "\n  '" + std::string(name) + "': " + std::string(about);
  };
  const auto list = [&](const std::string& title, std::span<const base::Choice> values) {
    text += "\n" + title;
    for (const base::Choice& value : values) add(value.word, value.hint);
  };
  list("deformer: decides how the cage moves the model.", choices(pose::Preset{}));
  list("weights: replaces the weights of the deformer. Some weights allow only some blends.",
       choices(pose::Weights{}));
  list("blend: replaces the blend of the deformer.", choices(pose::Blend{}));
  text +=
      "\narap: True solves for a mesh that is as rigid as possible.\niterations: ARAP: number of solves, 1 "
      "to " +
      std::to_string(pose::most_iterations) + ".";
  for (const pose::NumberEntry& number : pose::all_numbers())
    text += "\n" + std::string(number.word) + ": " + std::string(number.hint) + "; a fraction from " +
            plain(number.least) + " to " + plain(number.largest) + ".";
  list("method: the method for matrix exponentials.", {});
  for (const sym3::MethodEntry& method : sym3::methods()) add(method.name, method.sentence);
  return text;
}

struct Deformer::Impl {
  Impl(const Mesh& m, const Mesh& c, const Blending& blending, int threads)
      : model(library::deformable_surface_of(m, "the model")),
        cage(std::make_shared<const pose::Cage>(
            pose::make_cage(library::deformable_surface_of(c, "the cage")))),
        deformer(library::deformer_of(blending)),
        method(library::method_of(blending.method)),
        pool(library::checked_threads(threads)),
        notes(cage->warnings) {}

  pose::Pose pose(std::span<const double> numbers, const std::vector<Point3>* turns) const {
    pose::Pose pose{
        library::deformable_points(numbers, cage->surface.positions.size(), "the pose of the cage"), {}};
    check_turns(turns);
    if (turns) pose.turns = library::inside(*turns);
    return pose;
  }
  static void keep_turns(const pose::LogReport& report, std::vector<Point3>* turns) {
    if (turns) *turns = library::outside(report.turns);
  }

  deform::ExactDeformer& exact(base::Progress* progress = nullptr) {
    if (!exact_)
      exact_ = std::make_unique<deform::ExactDeformer>(model, cage, deformer, method, pool,
                                                       deform::ExactDeformer::Weights::kept, mask, progress);
    return *exact_;
  }

  deform::FrameDeformer& live(base::Progress* progress = nullptr) {
    if (live_) return *live_;
    const bool staged = pose::engine_for(deformer, method) == pose::EngineKind::staged;
    auto binding = std::make_shared<const weights::Binding>(weights::bind(
        mesh::lent(model), *cage, deformer.weighting, pose::EngineKind::fused, nullptr, pool, progress));
    if (staged)
      binding = std::make_shared<const weights::Binding>(
          weights::bind(mesh::lent(model), *cage, deformer.weighting, pose::EngineKind::staged, binding.get(),
                        pool, progress));
    std::shared_ptr<const deform::Stitching> stitching;
    if (deformer.stitched())
      stitching =
          std::make_shared<const deform::Stitching>(deform::stitch(model, *cage, pool, deformer, progress));
    live_ = std::make_unique<deform::FrameDeformer>(cage, std::move(binding), deformer, pool,
                                                    std::move(stitching));
    live_->set_mask(mask);
    live_->set_shape(shape);
    return *live_;
  }

  mesh::Surface model;
  std::shared_ptr<const pose::Cage> cage;
  pose::Deformer deformer;
  sym3::Method method;
  base::WorkerPool pool;
  std::vector<std::string> notes;
  std::optional<mesh::Adjacency> around;  // the triangles of each vertex
  weights::Mask mask;
  weights::SharedShape shape;
  std::unique_ptr<deform::ExactDeformer> exact_;  // created by exact(); live_ is created by live()
  std::unique_ptr<deform::FrameDeformer> live_;
};

Deformer::Deformer(const Mesh& model, const Mesh& cage, const Blending& blending, int threads)
    : impl_(library::hidden<Impl>(model, cage, blending, threads)) {}

void Deformer::bind(bool in_float, const Watch& watch) {
  library::watched(watch, [&](base::Progress* progress) {
    if (in_float)
      impl_->live(progress);
    else
      impl_->exact(progress);
  });
}

std::size_t Deformer::vertex_count() const {
  return impl_->model.positions.size();
}
const std::vector<std::string>& Deformer::notes() const {
  return impl_->notes;
}

void Deformer::deform(std::span<const double> cage, std::span<double> positions, std::span<double> normals,
                      std::vector<Point3>* turns) {
  const base::ForkDelay delay;
  check_sizes(positions.size(), normals.size(), vertex_count());
  const pose::Pose pose = impl_->pose(cage, turns);
  deform::ExactModel deformed = impl_->exact().deform(pose, {}, impl_->shape);
  const auto& shape = impl_->shape ? *impl_->shape : impl_->model.positions;
  files::keep_at_rest(*impl_->cage, pose, {}, shape, deformed.positions);
  library::check_finite(deformed.positions, "positions", "use a pose closer to the rest pose");
  Impl::keep_turns(deformed.report, turns);
  write(deformed.positions, positions);
  if (normals.empty()) return;
  if (!impl_->around) impl_->around = mesh::vertex_triangles(vertex_count(), impl_->model.triangles);
  std::vector<mesh::Point> all(vertex_count());
  mesh::vertex_normals(deformed.positions, impl_->model.triangles, *impl_->around, 0, all.size(), all);
  write(all, normals);
}

void Deformer::deform(std::span<const double> cage, std::span<float> positions, std::span<float> normals,
                      std::vector<Point3>* turns) {
  const base::ForkDelay delay;
  check_sizes(positions.size(), normals.size(), vertex_count());
  const pose::Pose pose = impl_->pose(cage, turns);
  deform::FrameDeformer& live = impl_->live();
  live.deform(pose, impl_->method);
  Impl::keep_turns(live.state().report(), turns);
  const auto vertices = live.vertices();
  const mesh::Vec3 origin = live.origin();
  std::atomic<bool> fits = true;
  impl_->pool.for_blocks(vertices.size(), 8192, [&](std::size_t begin, std::size_t end) {
    constexpr double largest = std::numeric_limits<float>::max();
    bool within = true;
    for (std::size_t v = begin; v < end; ++v) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = origin[k] + vertices[v].position[k];
        within &= std::abs(x) <= largest;  // false for NaN
        positions[3 * v + k] = static_cast<float>(x);
      }
      if (normals.empty()) continue;
      const mesh::Vec3 normal = base::unpack_normal(vertices[v].normal);
      std::copy_n(normal.begin(), 3, normals.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
    if (!within) fits = false;
  });
  if (!fits)
    throw base::Error("positions", "a coordinate exceeds the range of float",
                      "use double, or scale the cage and the model");
}

void Deformer::set_mask(std::span<const float> shares) {
  const base::ForkDelay delay;
  if (!shares.empty() && shares.size() != vertex_count())
    throw base::Error("the mask", "its size differs from the number of vertices",
                      "pass one value for each vertex");
  for (const float share : shares)
    if (!(share >= 0 && share <= 1))
      throw base::Error("the mask", "a value is not between 0 and 1", "limit the values to 0 to 1");
  impl_->mask =
      shares.empty() ? nullptr : std::make_shared<const std::vector<float>>(shares.begin(), shares.end());
  impl_->exact_.reset();
  if (impl_->live_) impl_->live_->set_mask(impl_->mask);
}

void Deformer::set_shape(std::span<const double> positions) {
  const base::ForkDelay delay;
  weights::SharedShape shape;
  if (!positions.empty())
    shape = std::make_shared<const std::vector<mesh::Point>>(
        library::deformable_points(positions, vertex_count(), "the shape"));
  impl_->shape = std::move(shape);
  if (impl_->live_) impl_->live_->set_shape(impl_->shape);
}

}  // namespace viete
