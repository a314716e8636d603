#include "deform/deformer.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <string>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "deform/fused_frame.h"
#include "deform/vertex_sample.h"
#include "deform/weigher.h"

namespace viete::deform {

namespace {

constexpr std::size_t vertices_per_block = 256;
constexpr std::size_t sample_limit = 2048;  // matrices
constexpr std::size_t error_sample = 512;   // vertices

// A block of a vector, for links that take spans.
template <class T>
std::span<T> part(std::vector<T>& all, std::size_t begin, std::size_t end) {
  return std::span(all).subspan(begin, end - begin);
}

}  // namespace

std::string_view name(Link link) {
  static constexpr std::array<std::string_view, link_count> names = {
      "face maps", "log maps", "blend", "exp", "apply", "skeleton", "fused", "normals"};
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
  if (binding_->tiles) {
    fused_ = std::make_unique<FusedFrame>(cage_, binding_->tiles, pool_);
    weigher_ = std::make_unique<Weigher>(*cage_, binding_->weighting());
  }
  if (!binding_->weights.empty()) allocate_staged();
  compute_normals();
}

Deformer::~Deformer() = default;

void Deformer::allocate_staged() {
  if (binding_->coordinates == Coordinates::mean_value) {
    posed_.resize(binding_->handles);
    return;
  }
  maps_.resize(binding_->handles);
  logs_.resize(binding_->handles);
  sums_ = {std::vector<sym3::Sym3<double>>(binding_->vertices), std::vector<Vec3>(binding_->vertices),
           std::vector<Vec3>(binding_->vertices)};
  stretches_.resize(binding_->vertices);
}

std::span<const sym3::Sym3<double>> Deformer::matrices() const {
  if (!fused_ran_) return sums_.stretch;
  if (!std::exchange(matrices_sampled_, true))
    sample_ = sample_stretches(*weigher_, *binding_, logs(), sample_limit);
  return sample_;
}

std::span<const mesh::Point> Deformer::positions() const {
  if (!std::exchange(vertices_taken_, true)) take_vertices();
  return positions_;
}

std::span<const mesh::Point> Deformer::normals() const {
  if (!std::exchange(vertices_taken_, true)) take_vertices();
  return normals_;
}

void Deformer::take_vertices() const {
  const auto vertices = fused_->vertices();
  const Vec3& origin = fused_->origin();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto &p = vertices[i].position, &n = vertices[i].normal;
    positions_[i] = origin + Vec3{p[0], p[1], p[2]};
    normals_[i] = {n[0], n[1], n[2]};
  }
}

std::span<const MapLog> Deformer::logs() const {
  return fused_ran_ ? fused_->logs() : std::span<const MapLog>(logs_);
}

double Deformer::sampled_error() const {
  if (!fused_ran_) return 0;
  const auto vertices = spread_vertices(*binding_, error_sample);
  std::vector<mesh::Point> exact;
  for (const auto v : vertices) exact.push_back(binding_->rest[v]);
  const BoundPart part = bind_part(*weigher_, exact);
  place_vertices(part.binding, fused_->posed_handles(), sym3::Method::fast, exact);
  double worst = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto& p = fused_->vertices()[vertices[i]].position;
    worst = std::max(worst, norm(fused_->origin() + Vec3{p[0], p[1], p[2]} - exact[i]));
  }
  return worst / cage_->diagonal;
}

std::optional<Path> Deformer::path(sym3::Method method) const {
  const bool any_method = binding_->coordinates == Coordinates::mean_value;
  if (fused_ && (any_method || method == sym3::Method::fast)) return Path::fused;
  if (!binding_->weights.empty()) return Path::staged;
  return std::nullopt;
}

void Deformer::set_dragging(bool on) {
  if (fused_) fused_->set_dragging(on);
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
  fused_ran_ = path(method) == Path::fused;
  if (fused_ran_) {
    fused_->deform(pose);
    vertices_taken_ = matrices_sampled_ = false;
    times_ = fused_->times();
    report_ = fused_->report();
    return;
  }
  assert(path(method));
  vertices_taken_ = true;
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
  const Vec3 origin = pose_origin(*cage_, pose.positions);
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
  const Vec3 origin = pose_origin(*cage_, pose.positions);
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
