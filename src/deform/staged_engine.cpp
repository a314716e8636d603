#include "deform/staged_engine.h"

#include <utility>

#include "base/clock.h"
#include "deform/map_rows.h"
#include "deform/moments.h"
#include "mesh/normals.h"

namespace viete::deform {

namespace {

constexpr std::size_t vertices_per_block = 256;

}  // namespace

StagedEngine::StagedEngine(std::shared_ptr<const Binding> binding, RowForm form, base::WorkerPool& pool)
    : binding_(std::move(binding)),
      pool_(pool),
      shares_(binding_->shares),
      positions_(binding_->vertices),
      normals_(binding_->vertices),
      vertices_(binding_->vertices) {
  const std::size_t n = binding_->vertices;
  if (!has_moments(form)) sums_.resize(n * shape(form).columns);
  if (form == RowForm::logs) logs_.resize(n), stretches_.resize(n);
}

template <class Body>
void StagedEngine::for_vertices(const Body& body) {
  pool_.for_blocks(binding_->vertices, vertices_per_block, body);
}

void StagedEngine::set_shape(std::span<const Vec3> ways) {
  ways_ = ways;
  if (ways_.empty()) return;
  shaped_.vertices = binding_->vertices, shaped_.rest_origin = binding_->rest_origin;
  shaped_.rest = binding_->rest, shaped_.offsets = binding_->offsets;
  shape_by(shaped_, ways_);
}

void StagedEngine::run(const CageState& state, sym3::Method method) {
  const Rows rows = state.rows();
  times_ = {};
  has_moments(rows.form) ? fit(rows) : blend_rows(rows, method);
  if (layer_) move_by_probes(method);
  finish(rows.origin);
}

void StagedEngine::move_by_probes(sym3::Method method) {
  base::Stopwatch watch;
  layer_->move_all(positions_, method);
  times_[Link::probes] = watch.lap_ms();
}

void StagedEngine::blend_rows(const Rows& rows, sym3::Method method) {
  base::Stopwatch watch;
  for_vertices([&](std::size_t begin, std::size_t end) {
    blend(*binding_, rows, begin, end, sums_);
    share_sums(places(), shares_, rows.form, begin, end, sums_);
    stretch_logs(rows.form, sums_, begin, end, logs_);
  });
  times_[Link::blend] = watch.lap_ms();
  if (rows.form == RowForm::logs) {
    for_vertices([&](std::size_t begin, std::size_t end) {
      const std::size_t count = end - begin;
      sym3::exp<double>(std::span(logs_).subspan(begin, count), std::span(stretches_).subspan(begin, count),
                        method);
    });
    times_[Link::exp] = watch.lap_ms();
  }
  for_vertices([&](std::size_t begin, std::size_t end) {
    apply(places(), shares_, rows.form, sums_, stretches_, rows.origin, begin, end, positions_);
  });
  times_[Link::apply] = watch.lap_ms();
}

// Sums and maps of a vertex are made together: what is summed depends on other sums.
void StagedEngine::fit(const Rows& rows) {
  base::Stopwatch watch;
  for_vertices([&](std::size_t begin, std::size_t end) {
    place_by_moments(*binding_, shares_, rows, ways_, begin, end, positions_);
  });
  times_[Link::blend] = watch.lap_ms();
}

void StagedEngine::finish(const Vec3& origin) {
  base::Stopwatch watch;
  for_vertices([&](std::size_t begin, std::size_t end) {
    mesh::vertex_normals(positions_, binding_->triangles, binding_->around, begin, end, normals_);
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 p = positions_[i] - origin;
      const Vec3& n = normals_[i];
      vertices_[i] = {{float(p[0]), float(p[1]), float(p[2])}, 0, {float(n[0]), float(n[1]), float(n[2])}, 0};
    }
  });
  times_[Link::normals] = watch.lap_ms();
}

}  // namespace viete::deform
