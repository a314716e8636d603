#include "deform/staged_engine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "deform/maps.h"
#include "deform/moments.h"
#include "mesh/normals.h"

namespace viete::deform {

namespace {

// Rows x columns of the product weights * table, with the sums in registers.
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

// Calls store(vertex, sums) for every vertex of [begin, end). `Rows` rows at once should fill the registers.
template <std::size_t Rows, std::size_t Columns, class Store>
void for_rows(const Binding& binding, const double* table, std::size_t begin, std::size_t end,
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
void blend_columns(const Binding& binding, const Rows& rows, std::size_t begin, std::size_t end,
                   std::span<double> sums) {
  constexpr std::size_t at_once = Columns < 4 ? 4 : 2;
  for_rows<at_once, Columns>(binding, rows.values.data(), begin, end,
                             [&](std::size_t i, const double(&s)[Columns]) {
                               std::copy_n(s, Columns, sums.begin() + std::ptrdiff_t(i * Columns));
                             });
}

}  // namespace

void blend(const Binding& binding, const Rows& rows, std::size_t begin, std::size_t end,
           std::span<double> sums) {
  switch (rows.columns()) {
    case 3: return blend_columns<3>(binding, rows, begin, end, sums);
    case 12: return blend_columns<12>(binding, rows, begin, end, sums);
    default: assert(false);  // no form has another number of columns
  }
}

namespace {

Vec3 offset_of(const Binding& binding, const Shares& shares, std::size_t i) {
  return shares.empty() ? binding.offsets[i] : shares[i] * binding.offsets[i];
}

// The part of the rest position that a share below 1 keeps.
Vec3 staying(const Binding& binding, double share, std::size_t i) {
  return (1 - share) * (binding.rest[i] - binding.rest_origin);
}

}  // namespace

void share_sums(const Binding& binding, const Shares& shares, RowForm form, std::size_t begin,
                std::size_t end, std::span<double> sums) {
  const std::size_t columns = shape(form).columns, center = shape(form).center;
  for (std::size_t i = begin; i < (shares.empty() ? begin : end); ++i) {
    const auto of = sums.subspan(i * columns, columns);
    for (double& sum : of) sum *= shares[i];
    const Vec3 rest = staying(binding, shares[i], i);
    for (std::size_t c = center; c < columns; ++c) of[c] += rest[c - center];
  }
}

namespace {

using Sums = std::span<const double>;

Vec3 three(Sums s, std::size_t first) {
  return {s[first], s[first + 1], s[first + 2]};
}

}  // namespace

void apply(const Binding& binding, const Shares& shares, RowForm form, Sums sums,
           std::span<const sym3::Sym3<double>> stretches, const Vec3& origin, std::size_t begin,
           std::size_t end, std::span<mesh::Point> positions) {
  const std::size_t columns = shape(form).columns;
  for (std::size_t i = begin; i < end; ++i) {
    const Sums s = sums.subspan(i * columns, columns);
    Vec3 moved;
    if (form == RowForm::maps) {
      const Vec3 x = binding.rest[i] - binding.rest_origin;
      moved = x + (times(sym3::Mat3<double>{s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8]}, x) +
                   three(s, 9));
    } else if (form == RowForm::positions) {
      moved = three(s, 0) + offset_of(binding, shares, i);
    } else {
      assert(form == RowForm::logs);  // moments use place_by_moments()
      const Vec3 stretched = times(stretches[i], offset_of(binding, shares, i));
      moved = times(sym3::exp_rotation(three(s, 6)), stretched) + three(s, 9);
    }
    positions[i] = origin + moved;
  }
}

void stretch_logs(RowForm form, Sums sums, std::size_t begin, std::size_t end,
                  std::span<sym3::Sym3<double>> logs) {
  const std::size_t columns = shape(form).columns;
  for (std::size_t i = begin; i < (form == RowForm::logs ? end : begin); ++i) {
    const double* x = sums.data() + i * columns;
    logs[i] = {x[0], x[1], x[2], x[3], x[4], x[5]};
  }
}

namespace {

using Stretch = sym3::Sym3<double>;

double squared_frobenius(const Stretch& m) {
  return m.xx * m.xx + m.yy * m.yy + m.zz * m.zz + 2 * (m.xy * m.xy + m.xz * m.xz + m.yz * m.yz);
}

double relative_difference(const Stretch& a, const Stretch& b) {
  const Stretch d{a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
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

double place_sums(const Binding& binding, RowForm form, Sums sums, const Vec3& origin, sym3::Method method,
                  std::span<mesh::Point> positions, bool error) {
  const std::size_t n = positions.size();
  std::vector<Stretch> logs(form == RowForm::logs ? n : 0), stretches(logs.size());
  stretch_logs(form, sums, 0, n, logs);
  sym3::exp<double>(logs, stretches, method);
  apply(binding, binding.shares, form, sums, stretches, origin, 0, n, positions);
  return error && method != sym3::Method::fast ? worst_difference(stretches, logs) : 0;
}

double place_vertices(const Binding& binding, const Rows& rows, sym3::Method method,
                      std::span<mesh::Point> positions) {
  const std::size_t n = positions.size();
  if (has_moments(rows.form)) {
    place_by_moments(binding, binding.shares, rows, {}, 0, n, positions);
    return 0;
  }
  std::vector<double> sums(n * rows.columns());
  blend(binding, rows, 0, n, sums);
  share_sums(binding, binding.shares, rows.form, 0, n, sums);
  return place_sums(binding, rows.form, sums, rows.origin, method, positions, true);
}

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

// Computes sums and maps of each vertex together, since some sums depend on others.
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
