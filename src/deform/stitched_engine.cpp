#include "deform/stitched_engine.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/clock.h"
#include "deform/staged_engine.h"
#include "pose/maps.h"
#include "sym3/polar.h"
#include "weights/leaves.h"

namespace viete::deform {

namespace {

constexpr std::size_t triangles_per_block = 128;
constexpr std::size_t gathered_per_block = 1024;  // vertices

using Mat = sym3::Mat3<double>;
using Stretch = sym3::Sym3<double>;

template <class Entries>
std::vector<std::size_t> vertices_of(const Entries& entries) {
  std::vector<std::size_t> vertices;
  for (const auto& entry : entries) vertices.push_back(entry.vertex);
  return vertices;
}

}  // namespace

// The maps M = rotation * stretch of a block of triangles. If split() is not called, rotation is M and
// stretch is I. The layout is [entry][triangle], so that vector code computes several triangles at once.
struct Stitcher::Maps {
  static constexpr std::size_t stride = sym3::padded_stride<double>(triangles_per_block);
  static constexpr std::size_t ahead = 12;  // prefetch distance of rows, in triangles
  static constexpr std::size_t used = 9;    // columns of a map's linear part
  using Plane = double[stride];

  alignas(64) Plane sums[used], stretches[6], rotations[9];

  void average(std::span<const double> of, pose::RowForm form, std::span<const mesh::Triangle> triangles) {
    const std::size_t columns = shape(form).columns;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      // Vertices are in file order, so hardware prefetching cannot predict which sums come next.
      for (const auto v : triangles[std::min(i + ahead, triangles.size() - 1)]) {
        __builtin_prefetch(of.data() + v * columns);
        __builtin_prefetch(of.data() + v * columns + 8);
      }
      const double *a = of.data() + triangles[i][0] * columns, *b = of.data() + triangles[i][1] * columns,
                   *c = of.data() + triangles[i][2] * columns;
      for (std::size_t k = 0; k < used; ++k) sums[k][i] = (1.0 / 3) * (a[k] + b[k] + c[k]);
    }
  }

  void rotate_by_logs(std::size_t count) {
    sym3::exp_rotation(sym3::VecView<const double>(sums[6], stride),
                       sym3::MatView<double>(rotations[0], stride), count);
  }
  void stretch_by_logs(std::size_t count, sym3::Method method) {
    if (method == sym3::Method::fast) {
      return sym3::exp(sym3::SymView<const double>(sums[0], stride),
                       sym3::SymView<double>(stretches[0], stride), count);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Stretch s =
          sym3::exp<double>({sums[0][i], sums[1][i], sums[2][i], sums[3][i], sums[4][i], sums[5][i]}, method);
      put(stretches, i, std::array{s.xx, s.xy, s.xz, s.yy, s.yz, s.zz});
    }
  }
  void take_whole(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      Mat m;
      for (std::size_t k = 0; k < 9; ++k) m[k] = sums[k][i];
      m[0] += 1;
      m[4] += 1;
      m[8] += 1;
      put(rotations, i, m);
      put(stretches, i, std::array<double, 6>{1, 0, 0, 1, 0, 1});
    }
  }
  void split(std::size_t count) {
    const sym3::MatView<double> maps(rotations[0], stride);
    sym3::polar(maps, maps, sym3::SymView<double>(stretches[0], stride), count);
  }

  void make(pose::RowForm form, std::size_t count, sym3::Method method, bool apart) {
    if (form == pose::RowForm::logs) {
      stretch_by_logs(count, method);
      return rotate_by_logs(count);
    }
    take_whole(count);
    if (apart) split(count);
  }

  // Multiplies one vector per triangle, in[x y z][triangle], by the triangle's stretch.
  void stretch(const Plane* in, Plane* out, std::size_t count) const {
    multiply<0, 1, 2, 1, 3, 4, 2, 4, 5>(stretches, in, out, count);
  }
  void rotate(const Plane* in, Plane* out, std::size_t count) const {
    multiply<0, 1, 2, 3, 4, 5, 6, 7, 8>(rotations, in, out, count);
  }
  template <int... plane>  // index in m of each matrix entry, by rows
  static void multiply(const Plane* m, const Plane* in, Plane* out, std::size_t count) {
    constexpr int k[] = {plane...};
    for (std::size_t i = 0; i < count; ++i) {
      const double x = in[0][i], y = in[1][i], z = in[2][i];
      for (int r = 0; r < 3; ++r)
        out[r][i] = m[k[3 * r]][i] * x + m[k[3 * r + 1]][i] * y + m[k[3 * r + 2]][i] * z;
    }
  }

  template <std::size_t N>
  static void put(Plane* planes, std::size_t i, const std::array<double, N>& entries) {
    for (std::size_t k = 0; k < N; ++k) planes[k][i] = entries[k];
  }
};

Stitcher::Stitcher(const Stitching& stitching, pose::RowForm form, base::WorkerPool& pool)
    : stitching_(stitching),
      form_(form),
      pool_(pool),
      loads_(3 * stitching_.triangles.size()),
      pin_targets_(stitching_.pins.size()),
      right_(stitching_.factors.size()),
      positions_(stitching_.factors.size()) {
  assert(form == pose::RowForm::logs || form == pose::RowForm::maps);
}

void Stitcher::set_shares(const weights::Shares& shares) {
  const auto all = stitching_.with_centers(std::span(shares));
  pin_shares_ = mesh::picked(std::span(all), vertices_of(stitching_.pins));
}

void Stitcher::set_shape(std::span<const Vec3> of_vertices) {
  const Stitching& s = stitching_;
  const std::vector<Vec3> all = s.with_centers(of_vertices);
  const std::span<const Vec3> displacements(all);
  shaped_gradients_.clear();
  pin_displacements_ = mesh::picked(displacements, vertices_of(s.pins));
  if (displacements.empty()) return;
  shaped_gradients_ = s.gradients_of(displacements, pool_);
  for (std::size_t t = 0; t < s.gradients.size(); ++t)
    for (const std::size_t i : {0, 1}) shaped_gradients_[t][i] = s.gradients[t][i] + shaped_gradients_[t][i];
}

void Stitcher::run(const pose::Rows& rows, std::span<const double> sums, std::span<const Vec3> held,
                   sym3::Method method, int iterations) {
  base::Stopwatch watch;
  loads_ms_ = solve_ms_ = 0;
  place_pins(rows, method);
  const bool has_centers = stitching_.vertices() < positions_.size();
  const auto all = has_centers ? stitching_.with_centers(sums, rows.columns()) : std::vector<double>();
  load_blended(has_centers ? std::span(all) : sums, method, iterations > 1);
  loads_ms_ += watch.lap_ms();
  solve(held);
  solve_ms_ += watch.lap_ms();
  for (int i = 1; i < iterations; ++i) {
    load_refitted();
    loads_ms_ += watch.lap_ms();
    solve(held);
    solve_ms_ += watch.lap_ms();
  }
}

// Computes the target of each pin: the position to which the pin's handle moves the pin's vertex.
void Stitcher::place_pins(const pose::Rows& rows, sym3::Method method) {
  const std::size_t columns = rows.columns(), n = pin_targets_.size();
  std::vector<double> sums(n * columns);
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(rows.values.begin() + std::ptrdiff_t(stitching_.pins[i].handle * columns), columns,
                sums.begin() + std::ptrdiff_t(i * columns));
  const weights::VertexBlock pins{stitching_.pinned, pin_shares_, pin_displacements_};
  apply_shares(pins, rows.form, 0, n, sums);
  apply_sums(pins, rows.form, sums, {0, 0, 0}, method, pin_targets_);
}

inline void Stitcher::set_load(std::size_t t, const Vec3& a, const Vec3& b) {
  loads_[3 * t] = a;
  loads_[3 * t + 1] = b;
  loads_[3 * t + 2] = Vec3{0, 0, 0} - (a + b);
}

void Stitcher::load_blended(std::span<const double> sums, sym3::Method method, bool keep_stretches) {
  if (keep_stretches) stretched_.resize(stitching_.triangles.size());
  const auto& gradients_at = shaped_gradients_.empty() ? stitching_.gradients : shaped_gradients_;
  pool_.for_blocks(stitching_.triangles.size(), triangles_per_block, [&](std::size_t begin, std::size_t end) {
    const auto triangles = std::span(stitching_.triangles).subspan(begin, end - begin);
    const std::size_t count = triangles.size();
    Maps maps;
    maps.average(sums, form_, triangles);
    maps.make(form_, count, method, keep_stretches);
    alignas(64) Maps::Plane gradients[6], stretched[6], loads[6];
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [a, b] = gradients_at[begin + i];
      Maps::put(gradients, i, std::array{a[0], a[1], a[2], b[0], b[1], b[2]});
    }
    for (const std::size_t corner : {0, 3}) {
      maps.stretch(gradients + corner, stretched + corner, count);
      maps.rotate(stretched + corner, loads + corner, count);
    }
    const auto of = [](const Maps::Plane* planes, std::size_t i) {
      return Vec3{planes[0][i], planes[1][i], planes[2][i]};
    };
    for (std::size_t i = 0; i < count; ++i) set_load(begin + i, of(loads, i), of(loads + 3, i));
    if (!keep_stretches) return;
    for (std::size_t i = 0; i < count; ++i) stretched_[begin + i] = {of(stretched, i), of(stretched + 3, i)};
  });
}

// Sets the loads with new rotations R. R is the rotation nearest to A = sum_i x'_i * (S * g_i)^T. This R
// maximises tr(R^T * A), the only term of the triangle's energy that depends on R.
void Stitcher::load_refitted() {
  pool_.for_blocks(stitching_.triangles.size(), triangles_per_block, [&](std::size_t begin, std::size_t end) {
    std::array<Mat, triangles_per_block> rotations;
    for (std::size_t t = begin; t < end; ++t) {
      const std::uint32_t as = stitching_.rotated_as[t];
      const auto& [a, b, c] = stitching_.triangles[as];
      const Vec3 u = positions_[a] - positions_[c], v = positions_[b] - positions_[c];
      const auto& [su, sv] = stretched_[as];
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t k = 0; k < 3; ++k) rotations[t - begin][3 * r + k] = u[r] * su[k] + v[r] * sv[k];
      }
    }
    const sym3::MatView<double> view{sym3::Layout::packed, rotations[0].data()};
    sym3::polar(view, view, end - begin);
    for (std::size_t t = begin; t < end; ++t)
      set_load(t, pose::times(rotations[t - begin], stretched_[t][0]),
               pose::times(rotations[t - begin], stretched_[t][1]));
  });
}

void Stitcher::solve(std::span<const Vec3> held) {
  const Stitching& s = stitching_;
  pool_.for_blocks(right_.size(), gathered_per_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place) {
      Vec3 sum{0, 0, 0};
      for (const auto i : s.around.of(place)) sum = sum + loads_[i];
      right_[s.order[place]] = sum;
    }
  });
  for (std::size_t i = 0; i < s.pins.size(); ++i) {
    Vec3& b = right_[s.pins[i].vertex];
    b = b + s.pins[i].weight * pin_targets_[i];
  }
  for (std::size_t i = 0; i < s.holds.size(); ++i) {
    Vec3& b = right_[s.holds[i].vertex];
    b = b + s.holds[i].weight * held[i];
  }
  s.factors.solve(right_, positions_, work_);
}

StitchedEngine::StitchedEngine(std::shared_ptr<const weights::Binding> binding,
                               std::shared_ptr<const Stitching> stitching, pose::RowForm form, int iterations,
                               base::WorkerPool& pool)
    : whole_(stitching->coarse ? std::make_unique<FusedEngine>(binding, form, pool) : nullptr),
      pool_(pool),
      bound_(stitching->coarse ? stitching->bound : std::move(binding)),
      binding_(bound_->tiles),
      stitching_(std::move(stitching)),
      form_(form),
      iterations_(iterations),
      blender_(bound_, form, pool),
      stitcher_(*stitching_, form, pool),
      slots_(slots_of(binding_->leaves)),
      held_(vertices_of(stitching_->holds)),
      sums_(stitching_->vertices() * shape(form).columns) {
  set_mask(nullptr);
}

void StitchedEngine::set_mask(const weights::Mask& mask) {
  mask_ = mask;
  if (whole_) whole_->set_mask(mask);
  const weights::Mask own = whole_ ? stitching_->coarse->means(mask) : mask;
  blender_.set_mask(own);
  shares_ = weights::product(shares_of(*binding_), weights::values(own));
  stitcher_.set_shares(shares_);
}

void StitchedEngine::set_shape(std::span<const Vec3> displacements) {
  if (whole_) {
    whole_->set_shape(displacements);
    displacements = coarse_displacements_ = stitching_->coarse->means(displacements, pool_);
  }
  displacements_ = displacements;
  blender_.set_shape(displacements);
  stitcher_.set_shape(displacements);
}

void StitchedEngine::run(const pose::CageState& state, sym3::Method method) {
  blender_.blend(state, sums_);
  base::Stopwatch watch;
  const auto held = blended(held_, method);
  const double held_ms = watch.lap_ms();
  stitcher_.run(state.rows(), sums_, held, method, iterations_);
  times_ = blender_.times();
  if (whole_) {
    times_ += move_whole(state, method);
  } else {
    blender_.set_layer(layer_);
    blender_.show(stitcher_.positions());
    times_ = blender_.times();
  }
  times_[pose::Stage::blend] += held_ms;
  times_[pose::Stage::triangle_maps] = stitcher_.loads_ms();
  times_[pose::Stage::solve] = stitcher_.solve_ms();
}

// Blends the whole model, and moves it as stitching moved the coarse model. Returns the times of both.
pose::StageTimes StitchedEngine::move_whole(const pose::CageState& state, sym3::Method method) {
  const weights::CoarseModel& coarse = *stitching_->coarse;
  whole_->set_layer(nullptr);
  whole_->run(state);
  pose::StageTimes times = whole_->times();
  base::Stopwatch watch;
  positions_.resize(whole_->vertices().size());
  pool_.for_blocks(positions_.size(), gathered_per_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto& p = whole_->vertices()[v].position;
      positions_[v] = {p[0], p[1], p[2]};
    }
  });
  sample_ = mesh::picked(std::span<const Vec3>(positions_),
                         weights::spread_vertices(positions_.size(), weights::error_sample));
  std::vector<Vec3> moves =
      coarse.is_lattice() ? blended(weights::spread_vertices(bound_->vertices, bound_->vertices), method)
                          : coarse.means(positions_, pool_);
  for (std::size_t c = 0; c < moves.size(); ++c) moves[c] = stitcher_.positions()[c] - moves[c];
  coarse.move(moves, mask_, positions_, pool_);
  times[pose::Stage::apply] = watch.lap_ms();
  whole_->set_layer(layer_);
  whole_->show(positions_);
  for (const pose::Stage stage : {pose::Stage::normals, pose::Stage::probes})
    times[stage] += whole_->times()[stage];
  return times;
}

std::vector<Vec3> StitchedEngine::blended_sample() const {
  if (whole_) return sample_;
  return blended(weights::spread_vertices(bound_->vertices, weights::error_sample), sym3::Method::fast);
}

std::vector<Vec3> StitchedEngine::blended(std::span<const std::size_t> vertices, sym3::Method method) const {
  const std::size_t columns = shape(form_).columns;
  weights::Binding some;
  some.rest =
      std::make_shared<const std::vector<mesh::Point>>(mesh::picked(std::span(*bound_->rest), vertices));
  some.rest_origin = bound_->rest_origin;
  const weights::TileLines<const float> offsets{binding_->offsets.data(), 3};
  std::vector<double> sums;
  for (const auto v : vertices) {
    some.offsets.push_back(binding_->unit * offsets.three(slots_[v], 0));
    const auto from = std::span(sums_).subspan(v * columns, columns);
    sums.insert(sums.end(), from.begin(), from.end());
  }
  std::vector<Vec3> positions(vertices.size());
  const weights::Shares shares = mesh::picked(std::span(shares_), vertices);
  const auto displacements = mesh::picked(displacements_, vertices);
  apply_sums({some, shares, displacements}, form_, sums, {0, 0, 0}, method, positions);
  return positions;
}

}  // namespace viete::deform
