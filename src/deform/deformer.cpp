#include "deform/deformer.h"

#include <numeric>
#include <string>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "deform/vec3.h"

namespace viete::deform {

namespace {

constexpr std::size_t vertices_per_block = 256;

// A block of a vector, for links that take spans.
template <class T>
std::span<T> part(std::vector<T>& all, std::size_t begin, std::size_t end) {
  return std::span(all).subspan(begin, end - begin);
}

}  // namespace

std::string_view name(Link link) {
  static constexpr std::array<std::string_view, link_count> names = {
      "face maps", "log maps", "blend", "exp", "apply", "fused", "normals"};
  return names[static_cast<std::size_t>(link)];
}

double LinkTimes::total() const {
  return std::accumulate(ms.begin(), ms.end(), 0.0);
}

Deformer::Deformer(std::shared_ptr<const Cage> cage, std::shared_ptr<const Binding> binding,
                   base::WorkerPool& pool)
    : cage_(std::move(cage)),
      binding_(std::move(binding)),
      pool_(pool),
      positions_(binding_->rest),
      normals_(binding_->vertices) {
  report_.turns.assign(cage_->roots.size(), {0, 0, 0});
  if (binding_->coordinates == Coordinates::mean_value) {
    posed_.resize(binding_->handles);
  } else {
    maps_.resize(binding_->handles);
    logs_.resize(binding_->handles);
    sums_ = {std::vector<sym3::Sym3<double>>(binding_->vertices), std::vector<Vec3>(binding_->vertices),
             std::vector<Vec3>(binding_->vertices)};
    stretches_.resize(binding_->vertices);
  }
  compute_normals();
}

std::span<const sym3::Sym3<double>> Deformer::matrices() const {
  return sums_.stretch;
}

void check_pose(const Cage& cage, const Pose& pose) {
  const std::size_t expected = cage.surface.positions.size();
  if (pose.positions.size() == expected) return;
  throw base::Error("",
                    "the pose has " + std::to_string(pose.positions.size()) + " vertices, the cage " +
                        std::to_string(expected),
                    "use a pose of this cage");
}

void Deformer::deform(const Pose& pose, sym3::Method method) {
  check_pose(*cage_, pose);
  times_ = {};
  if (binding_->coordinates == Coordinates::mean_value) {
    deform_mean_value(pose);
  } else {
    deform_faces(pose, method);
  }
  base::Stopwatch watch;
  compute_normals();
  times_[Link::normals] = watch.lap_ms();
}

void Deformer::deform_faces(const Pose& pose, sym3::Method method) {
  base::Stopwatch watch;
  const Vec3 origin = pose_origin(pose.positions);
  face_maps(*cage_, pose.positions, maps_);
  times_[Link::face_maps] = watch.lap_ms();
  log_maps(*cage_, maps_, pose.turns, logs_, report_);
  times_[Link::log_maps] = watch.lap_ms();
  const std::size_t n = binding_->vertices;
  pool_.for_blocks(n, vertices_per_block,
                   [&](std::size_t begin, std::size_t end) { blend(*binding_, logs_, begin, end, sums_); });
  times_[Link::blend] = watch.lap_ms();
  pool_.for_blocks(n, vertices_per_block, [&](std::size_t begin, std::size_t end) {
    sym3::exp<double>(part(sums_.stretch, begin, end), part(stretches_, begin, end), method);
  });
  times_[Link::exp] = watch.lap_ms();
  pool_.for_blocks(n, vertices_per_block, [&](std::size_t begin, std::size_t end) {
    apply(*binding_, sums_, stretches_, origin, begin, end, positions_);
  });
  times_[Link::apply] = watch.lap_ms();
}

void Deformer::deform_mean_value(const Pose& pose) {
  base::Stopwatch watch;
  const Vec3 origin = pose_origin(pose.positions);
  for (std::size_t i = 0; i < posed_.size(); ++i) posed_[i] = pose.positions[i] - origin;
  pool_.for_blocks(binding_->vertices, vertices_per_block, [&](std::size_t begin, std::size_t end) {
    blend_positions(*binding_, posed_, origin, begin, end, positions_);
  });
  times_[Link::blend] = watch.lap_ms();
  report_ = {pose.turns, {}, {}};
}

void Deformer::compute_normals() {
  pool_.for_blocks(binding_->vertices, vertices_per_block, [&](std::size_t begin, std::size_t end) {
    mesh::vertex_normals(positions_, binding_->triangles, binding_->around, begin, end, normals_);
  });
}

}  // namespace viete::deform
