#include "deform/staged_engine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "deform/moments.h"
#include "mesh/normals.h"
#include "pose/maps.h"

namespace viete::deform {

namespace {

// Computes Rows x Columns entries of the product weights * table, with the sums in registers.
template <std::size_t Rows, std::size_t Columns>
void product(const double* weights, const double* table, std::size_t handles, double (&sums)[Rows][Columns]) {
  double s[Rows][Columns] = {};
  for (std::size_t j = 0; j < handles; ++j) {
    const double* entry = table + j * Columns;
    for (std::size_t r = 0; r < Rows; ++r) {
      const double w = weights[r * handles + j];
      for (std::size_t c = 0; c < Columns; ++c) s[r][c] += w * entry[c];
    }
  }
  for (std::size_t r = 0; r < Rows; ++r) {
    for (std::size_t c = 0; c < Columns; ++c) sums[r][c] = s[r][c];
  }
}

// Calls store(vertex, sums) for the vertices [begin, end). Computes the sums of `Rows` vertices at a time.
template <std::size_t Rows, std::size_t Columns, class Store>
void for_rows(const weights::Binding& binding, const double* table, std::size_t begin, std::size_t end,
              const Store& store) {
  const std::size_t k = binding.handles;
  std::size_t i = begin;
  for (; i + Rows <= end; i += Rows) {
    double sums[Rows][Columns];
    product<Rows, Columns>(binding.weights.data() + i * k, table, k, sums);
    for (std::size_t r = 0; r < Rows; ++r) store(i + r, sums[r]);
  }
  for (; i < end; ++i) {
    double sums[1][Columns];
    product<1, Columns>(binding.weights.data() + i * k, table, k, sums);
    store(i, sums[0]);
  }
}

template <std::size_t Columns>
void blend_columns(const weights::Binding& binding, const pose::Rows& rows, std::size_t begin,
                   std::size_t end, std::span<double> sums) {
  constexpr std::size_t at_once = Columns < 4 ? 4 : 2;
  for_rows<at_once, Columns>(binding, rows.values.data(), begin, end,
                             [&](std::size_t i, const double(&s)[Columns]) {
                               std::copy_n(s, Columns, sums.begin() + std::ptrdiff_t(i * Columns));
                             });
}

using Sums = std::span<const double>;
using Stretch = sym3::Sym3<double>;

Vec3 three(Sums s, std::size_t first) {
  return {s[first], s[first + 1], s[first + 2]};
}

double squared_frobenius(const Stretch& m) {
  return m.xx * m.xx + m.yy * m.yy + m.zz * m.zz + 2 * (m.xy * m.xy + m.xz * m.xz + m.yz * m.yz);
}

double relative_difference(const Stretch& a, const Stretch& b) {
  const Stretch d = pose::plus(a, -1, b);
  const double difference = std::sqrt(squared_frobenius(d) / squared_frobenius(b));
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

double worst_difference(std::span<const Stretch> computed, std::span<const Stretch> logs) {
  std::vector<Stretch> exact(logs.size());
  sym3::exp<double>(logs, exact);
  double worst = 0;
  for (std::size_t i = 0; i < logs.size(); ++i)
    worst = std::max(worst, relative_difference(computed[i], exact[i]));
  return worst;
}

}  // namespace

void blend(const weights::VertexBlock& block, const pose::Rows& rows, std::size_t begin, std::size_t end,
           std::span<double> sums) {
  assert(rows.columns() == 3 || rows.columns() == 12);  // forms without moments
  rows.columns() == 3 ? blend_columns<3>(block.binding, rows, begin, end, sums)
                      : blend_columns<12>(block.binding, rows, begin, end, sums);
  apply_shares(block, rows.form, begin, end, sums);
}

void apply_shares(const weights::VertexBlock& block, pose::RowForm form, std::size_t begin, std::size_t end,
                  std::span<double> sums) {
  if (block.shares.empty()) return;
  const std::size_t columns = shape(form).columns, center = shape(form).center;
  for (std::size_t i = begin; i < end; ++i) {
    const double share = block.shares[i];
    const auto of = sums.subspan(i * columns, columns);
    for (double& sum : of) sum *= share;
    const Vec3 rest = (1 - share) * (block.rest(i) - block.binding.rest_origin);
    for (std::size_t c = center; c < columns; ++c) of[c] += rest[c - center];
  }
}

void apply(const weights::VertexBlock& block, pose::RowForm form, Sums sums,
           std::span<const Stretch> stretches, const Vec3& origin, std::size_t begin, std::size_t end,
           std::span<mesh::Point> positions) {
  const std::size_t columns = shape(form).columns;
  for (std::size_t i = begin; i < end; ++i) {
    const Sums s = sums.subspan(i * columns, columns);
    Vec3 moved;
    if (form == pose::RowForm::maps) {
      const Vec3 x = block.rest(i) - block.binding.rest_origin;
      moved = x + (pose::times(sym3::Mat3<double>{s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8]}, x) +
                   three(s, 9));
    } else if (form == pose::RowForm::positions) {
      moved = three(s, 0) + block.share(i) * block.offset(i);
    } else {
      assert(form == pose::RowForm::logs);  // for moments, see apply_moments()
      const Vec3 stretched = pose::times(stretches[i], block.share(i) * block.offset(i));
      moved = pose::times(sym3::exp_rotation(three(s, 6)), stretched) + three(s, 9);
    }
    positions[i] = origin + moved;
  }
}

void stretch_logs(Sums sums, std::size_t begin, std::size_t end, std::span<Stretch> logs) {
  for (std::size_t i = begin; i < end; ++i) {
    const double* x = sums.data() + i * pose::log_shape.columns;
    logs[i] = {x[0], x[1], x[2], x[3], x[4], x[5]};
  }
}

double apply_sums(const weights::VertexBlock& block, pose::RowForm form, Sums sums, const Vec3& origin,
                  sym3::Method method, std::span<mesh::Point> positions, bool error) {
  std::vector<Stretch> logs(form == pose::RowForm::logs ? positions.size() : 0), stretches(logs.size());
  stretch_logs(sums, 0, logs.size(), logs);
  sym3::exp<double>(logs, stretches, method);
  apply(block, form, sums, stretches, origin, 0, positions.size(), positions);
  return error && method != sym3::Method::fast ? worst_difference(stretches, logs) : 0;
}

double apply_to_vertices(const weights::VertexBlock& block, const pose::Rows& rows, sym3::Method method,
                         std::span<mesh::Point> positions, std::span<double> sums) {
  const std::size_t n = positions.size();
  if (has_moments(rows.form)) {
    apply_moments(block, rows, 0, n, positions);
    return 0;
  }
  std::vector<double> own(sums.empty() ? n * rows.columns() : 0);
  if (sums.empty()) sums = own;
  blend(block, rows, 0, n, sums);
  return apply_sums(block, rows.form, sums, rows.origin, method, positions, true);
}

StagedEngine::StagedEngine(std::shared_ptr<const weights::Binding> binding, pose::RowForm form,
                           base::WorkerPool& pool)
    : binding_(std::move(binding)),
      pool_(pool),
      shares_(binding_->shares),
      positions_(binding_->vertices),
      normals_(binding_->vertices),
      vertices_(binding_->vertices) {
  const std::size_t n = binding_->vertices;
  if (!has_moments(form)) sums_.resize(n * shape(form).columns);
  if (form == pose::RowForm::logs) {
    logs_.resize(n);
    stretches_.resize(n);
  }
}

template <class Body>
void StagedEngine::run_stage(pose::Stage stage, const Body& body) {
  constexpr std::size_t vertices_per_block = 256;
  base::Stopwatch watch;
  pool_.for_blocks(binding_->vertices, vertices_per_block, body);
  times_[stage] = watch.lap_ms();
}

void StagedEngine::run(const pose::CageState& state, sym3::Method method) {
  const pose::Rows rows = state.rows();
  const weights::VertexBlock block{*binding_, shares_, displacements_};
  times_ = {};
  if (has_moments(rows.form)) {
    // One step computes the sums and the map of a vertex, because some sums depend on other sums.
    run_stage(pose::Stage::blend, [&](std::size_t begin, std::size_t end) {
      apply_moments(block, rows, begin, end, positions_);
    });
  } else {
    run_stage(pose::Stage::blend, [&](std::size_t begin, std::size_t end) {
      blend(block, rows, begin, end, sums_);
      if (!logs_.empty()) stretch_logs(sums_, begin, end, logs_);
    });
    if (!logs_.empty()) {
      run_stage(pose::Stage::exp, [&](std::size_t begin, std::size_t end) {
        sym3::exp<double>(std::span(logs_).subspan(begin, end - begin),
                          std::span(stretches_).subspan(begin, end - begin), method);
      });
    }
    run_stage(pose::Stage::apply, [&](std::size_t begin, std::size_t end) {
      apply(block, rows.form, sums_, stretches_, rows.origin, begin, end, positions_);
    });
  }
  if (layer_) {
    base::Stopwatch watch;
    layer_->move_all(positions_, method);
    times_[pose::Stage::probes] = watch.lap_ms();
  }
  run_stage(pose::Stage::normals, [&](std::size_t begin, std::size_t end) {
    mesh::vertex_normals(positions_, binding_->model->triangles, binding_->around, begin, end, normals_);
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 p = positions_[i] - rows.origin;
      vertices_[i] = {{float(p[0]), float(p[1]), float(p[2])}, base::pack_normal(normals_[i])};
    }
  });
}

}  // namespace viete::deform
