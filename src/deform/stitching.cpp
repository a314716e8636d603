#include "deform/stitching.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "deform/apply.h"
#include "deform/face_maps.h"
#include "deform/inverse_distance.h"
#include "deform/leaves.h"
#include "deform/map_rows.h"
#include "deform/matrix_log.h"
#include "mesh/triangle.h"
#include "mesh/union_find.h"
#include "sym3/polar.h"

namespace viete::deform {

namespace {

constexpr double found_pins = 0.5;  // of the time
constexpr double hold_of_loose_vertex = 1;
constexpr double hold_of_loose_part = 1e-4;
constexpr double indistinguishable = 1e-9;  // distances, in diagonals
constexpr std::size_t triangles_per_block = 128;
constexpr std::size_t gathered_per_block = 1024;  // vertices

using Mat = sym3::Mat3<double>;
using Stretch = sym3::Sym3<double>;

Vec3 image(const Mat& m, const Vec3& x) {
  return {m[0] * x[0] + m[1] * x[1] + m[2] * x[2], m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
          m[6] * x[0] + m[7] * x[1] + m[8] * x[2]};
}

// Area times the gradients of the hat functions of the first two corners: rows of the triangle's stiffness
// matrix times its corners.
std::array<Vec3, 2> area_gradients(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c) {
  const Vec3 h = half_cotangents(a, b, c);
  return {h[2] * (a - b) + h[1] * (a - c), h[2] * (b - a) + h[0] * (b - c)};
}

// The triangle nearest to a point, of those that are not thin; none: the number of triangles. Where several
// share the nearest point, or what is as near but for rounding, the one whose centre is nearest.
class NearestTriangle {
public:
  NearestTriangle(const mesh::Surface& model, std::span<const std::uint8_t> thin, double slack)
      : positions_(model.positions), triangles_(model.triangles), thin_(thin), slack_(slack) {}

  std::size_t operator()(const mesh::Point& point) const {
    double least = std::numeric_limits<double>::infinity();
    for_near(point, least, [&](std::size_t, double d) { least = std::min(least, d); });
    double nearest_center = std::numeric_limits<double>::infinity();
    std::size_t nearest = triangles_.size();
    const double enough = least + slack_;
    for_near(point, enough, [&](std::size_t t, double d) {
      const double center = d <= enough ? squared_norm(point - center_of(triangles_[t])) : nearest_center;
      if (center < nearest_center) nearest_center = center, nearest = t;
    });
    return nearest;
  }

private:
  Vec3 center_of(const mesh::Triangle& t) const {
    return (1.0 / 3) * (positions_[t[0]] + positions_[t[1]] + positions_[t[2]]);
  }

  // visit(triangle, distance) of all that may be so near, and some others.
  template <class Visit>
  void for_near(const mesh::Point& point, const double& limit, const Visit& visit) const {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (thin_[t]) continue;
      const mesh::Point &a = positions_[triangles_[t][0]], &b = positions_[triangles_[t][1]],
                        &c = positions_[triangles_[t][2]];
      const double side = std::sqrt(std::max(squared_norm(b - a), squared_norm(c - a)));
      const double farthest = limit + side;  // no corner of a nearer one is beyond
      if (squared_norm(point - a) > farthest * farthest) continue;
      visit(t, std::sqrt(mesh::closest_on_triangle(point, a, b, c).squared_distance));
    }
  }

  std::span<const mesh::Point> positions_;
  std::span<const mesh::Triangle> triangles_;
  std::span<const std::uint8_t> thin_;
  double slack_;
};

class StitchMaker {
public:
  StitchMaker(const mesh::Surface& model, const Cage& cage, Elements elements,
              const StitchingSettings& settings, base::WorkerPool& pool, base::Progress* progress)
      : model_(model),
        cage_(cage),
        elements_(elements),
        settings_(settings),
        pool_(pool),
        progress_(progress) {}

  Stitching make() {
    find_thin();
    find_pins();
    hold_the_rest();
    SparseMatrix matrix = stiffness_matrix(model_.positions, model_.triangles);
    add_diagonal(matrix);
    Stitching s{entry(elements_).handles,
                settings_,
                {},
                {},
                {},
                {},
                std::move(pins_),
                {},
                std::move(holds_),
                SparseCholesky(matrix, pool_, told(progress_, found_pins, 1))};
    fill_triangles(s);
    fill_pinned(s);
    return s;
  }

private:
  void find_thin() {
    const auto& p = model_.positions;
    thin_.resize(model_.triangles.size());
    for (std::size_t t = 0; t < thin_.size(); ++t) {
      const auto& [a, b, c] = model_.triangles[t];
      thin_[t] = is_thin(p[a], p[b], p[c]);
    }
  }

  void find_pins() {
    const auto centers = handle_centers(cage_, elements_);
    std::vector<std::vector<Stitching::Pin>> found(centers.size());
    pool_.for_blocks(centers.size(), 1, [&](std::size_t h, std::size_t) {
      if (progress_)
        progress_->report(found_pins * static_cast<double>(h) / static_cast<double>(centers.size()));
      if (handle_shape(cage_, entry(elements_).handles, h).weighs)
        found[h] = pins_of(static_cast<std::uint32_t>(h), centers[h]);
    });
    for (const auto& pins : found) pins_.insert(pins_.end(), pins.begin(), pins.end());
  }

  std::vector<Stitching::Pin> pins_of(std::uint32_t handle, const mesh::Point& center) const {
    std::vector<Stitching::Pin> pins;
    const std::size_t t = NearestTriangle(model_, thin_, indistinguishable * cage_.diagonal)(center);
    if (t < model_.triangles.size()) {
      for (const auto v : model_.triangles[t]) pins.push_back({v, handle, settings_.pin});
    }
    const double radius = settings_.radius * cage_.diagonal;
    for (std::uint32_t v = 0; radius > 0 && v < model_.positions.size(); ++v) {
      const double d = norm(model_.positions[v] - center);
      if (d < radius)
        pins.push_back({v, handle, settings_.pin * std::pow((radius - d) / radius, settings_.exponent)});
    }
    return pins;
  }

  void hold_the_rest() {
    const std::size_t n = model_.positions.size();
    mesh::UnionFind parts(n);
    std::vector<std::uint8_t> firm(n, 0), pinned(n, 0);  // by vertex; by the number of its part
    for (std::size_t t = 0; t < thin_.size(); ++t) {
      if (thin_[t]) continue;
      const auto& [a, b, c] = model_.triangles[t];
      parts.join(a, b), parts.join(b, c);
      firm[a] = firm[b] = firm[c] = 1;
    }
    for (const auto& pin : pins_) pinned[parts.find(pin.vertex)] = 1;
    for (std::uint32_t v = 0; v < n; ++v) {
      double weight = settings_.translation;
      if (!firm[v]) {
        weight += hold_of_loose_vertex;
      } else if (!pinned[parts.find(v)]) {
        weight += hold_of_loose_part;
      }
      if (weight > 0) holds_.push_back({v, weight});
    }
  }

  void add_diagonal(SparseMatrix& matrix) const {
    std::vector<double> firmness(matrix.size(), 0.0);
    for (const auto& pin : pins_) firmness[pin.vertex] += pin.weight;
    for (const auto& hold : holds_) firmness[hold.vertex] += hold.weight;
    for (std::size_t v = 0; v < matrix.size(); ++v) {
      for (auto i = matrix.starts[v]; i < matrix.starts[v + 1]; ++i) {
        if (static_cast<std::size_t>(matrix.rows[i]) == v) matrix.values[i] += firmness[v];
      }
    }
  }

  void fill_triangles(Stitching& s) const {
    const auto& p = model_.positions;
    const std::vector<std::uint32_t> places = order_vertices(s);
    for (const mesh::Triangle& t : model_.triangles) {
      if (!mesh::repeats_corner(t)) s.triangles.push_back(t);
    }
    const auto first_place = [&](const mesh::Triangle& t) {
      return std::min({places[t[0]], places[t[1]], places[t[2]]});
    };
    std::ranges::stable_sort(s.triangles, {}, first_place);
    for (const mesh::Triangle& t : s.triangles)
      s.gradients.push_back(area_gradients(p[t[0]], p[t[1]], p[t[2]]));
    s.around = mesh::make_adjacency(p.size(), [&](const auto& add) {
      for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) add(places[s.triangles[t][k]], 3 * t + k);
      }
    });
  }

  // Fills the order; returns each vertex's place in it.
  std::vector<std::uint32_t> order_vertices(Stitching& s) const {
    const std::size_t n = model_.positions.size();
    Leaves leaves = make_leaves(model_.positions, std::vector<std::uint32_t>(n, 0));
    leaves.order.resize(n);  // without padding
    s.order = std::move(leaves.order);
    std::vector<std::uint32_t> places(n);
    for (std::uint32_t i = 0; i < n; ++i) places[s.order[i]] = i;
    return places;
  }

  void fill_pinned(Stitching& s) const {
    const auto centers = handle_centers(cage_, elements_);
    Binding& b = s.pinned;
    b.vertices = s.pins.size();
    b.rest_origin = middle(cage_.surface.positions);
    for (const auto& pin : s.pins) {
      b.rest.push_back(model_.positions[pin.vertex]);
      b.offsets.push_back(model_.positions[pin.vertex] - centers[pin.handle]);
    }
  }

  const mesh::Surface& model_;
  const Cage& cage_;
  Elements elements_;
  StitchingSettings settings_;
  base::WorkerPool& pool_;
  base::Progress* progress_;
  std::vector<std::uint8_t> thin_;
  std::vector<Stitching::Pin> pins_;
  std::vector<Stitching::Hold> holds_;
};

}  // namespace

std::size_t stitching_bytes(std::size_t vertices) {
  // factors by n log n; gradients, loads and stretches of two triangles a vertex; lists; right sides
  const auto n = static_cast<double>(vertices);
  return static_cast<std::size_t>(n * (12 * 2.2 * std::log2(n + 2) + 2 * (12 + 48 + 72 + 48) + 28 + 80));
}

StitchingSettings settings_of(const Holding& holding) {
  return {.radius = holding.radius, .translation = holding.weight};
}

Stitching stitch(const mesh::Surface& model, const Cage& cage, Elements elements, base::WorkerPool& pool,
                 const StitchingSettings& settings, base::Progress* progress) {
  if (model.positions.empty()) throw base::Error("", "the model has no vertices", "choose another file");
  const base::MemoryNeed need{static_cast<double>(stitching_bytes(model.positions.size())),
                              "stitching " + std::to_string(model.positions.size()) + " vertices takes",
                              "use a coarser model, or leave stitching off", ""};
  base::require_memory(need);
  try {
    return StitchMaker(model, cage, elements, settings, pool, progress).make();
  } catch (const std::bad_alloc&) {
    base::refuse_memory(need);
  }
}

// The maps of a block of triangles, as M = rotation stretch where the form has them apart, else as M = M I;
// number by number, [entry][triangle], so that vector code goes along the triangles.
struct Stitcher::Maps {
  static constexpr std::size_t stride = sym3::padded_stride<double>(triangles_per_block);
  static constexpr std::size_t ahead = 12;      // triangles, whose rows are asked for before they are needed
  static constexpr std::size_t most_used = 10;  // columns that make a map's linear part
  using Plane = double[stride];

  alignas(64) Plane sums[most_used], stretches[6], rotations[9];

  void average(std::span<const double> of, RowForm form, std::span<const mesh::Triangle> triangles) {
    const std::size_t columns = shape(form).columns, used = form == RowForm::quaternions ? 10 : 9;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      // Rows of vertices lie in the file's order, which no processor guesses.
      for (const auto v : triangles[std::min(i + ahead, triangles.size() - 1)]) {
        __builtin_prefetch(of.data() + v * columns);
        __builtin_prefetch(of.data() + v * columns + 8);
      }
      const double *a = of.data() + triangles[i][0] * columns, *b = of.data() + triangles[i][1] * columns,
                   *c = of.data() + triangles[i][2] * columns;
      for (std::size_t k = 0; k < used; ++k) sums[k][i] = (1.0 / 3) * (a[k] + b[k] + c[k]);
    }
  }

  void rotate(std::size_t first, std::size_t count) {
    sym3::exp_rotation(sym3::VecView<const double>(sums[first], stride),
                       sym3::MatView<double>(rotations[0], stride), count);
  }
  void stretch_by_sums(std::size_t count) {
    for (std::size_t k = 0; k < 6; ++k) {
      const double one = k == 0 || k == 3 || k == 5;
      for (std::size_t i = 0; i < count; ++i) stretches[k][i] = one + sums[k][i];
    }
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
  void rotate_by_quaternions(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      put(rotations, i, rotation_of({1 + sums[6][i], sums[7][i], sums[8][i], sums[9][i]}));
  }
  void take_whole(std::size_t count, bool by_log) {
    for (std::size_t i = 0; i < count; ++i) {
      Mat m;
      for (std::size_t k = 0; k < 9; ++k) m[k] = sums[k][i];
      if (by_log) {
        m = matrix_exp(m);
      } else {
        m[0] += 1, m[4] += 1, m[8] += 1;
      }
      put(rotations, i, m);
      put(stretches, i, std::array<double, 6>{1, 0, 0, 1, 0, 1});
    }
  }
  // Into factors, where those are needed.
  void split(std::size_t count) {
    const sym3::MatView<double> maps(rotations[0], stride);
    sym3::polar(maps, maps, sym3::SymView<double>(stretches[0], stride), count);
  }

  void make(RowForm form, std::size_t count, sym3::Method method, bool apart) {
    switch (form) {
      case RowForm::logs:
      case RowForm::screws: stretch_by_logs(count, method), rotate(6, count); return;
      case RowForm::stretches: stretch_by_sums(count), rotate(6, count); return;
      case RowForm::quaternions: stretch_by_sums(count), rotate_by_quaternions(count); return;
      case RowForm::matrix_logs:
      case RowForm::affine_logs: take_whole(count, true); break;
      case RowForm::maps: take_whole(count, false); break;
      case RowForm::positions:
      case RowForm::affine_moments:
      case RowForm::similar_moments:
      case RowForm::rigid_moments: assert(false);  // refused by conflict()
    }
    if (apart) split(count);
  }

  // out = stretch in, and the same of rotations: of all triangles, out and in being x y z.
  void stretch(const Plane* in, Plane* out, std::size_t count) const {
    const Plane* s = stretches;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = in[0][i], y = in[1][i], z = in[2][i];
      out[0][i] = s[0][i] * x + s[1][i] * y + s[2][i] * z;
      out[1][i] = s[1][i] * x + s[3][i] * y + s[4][i] * z;
      out[2][i] = s[2][i] * x + s[4][i] * y + s[5][i] * z;
    }
  }
  void rotate(const Plane* in, Plane* out, std::size_t count) const {
    const Plane* r = rotations;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = in[0][i], y = in[1][i], z = in[2][i];
      out[0][i] = r[0][i] * x + r[1][i] * y + r[2][i] * z;
      out[1][i] = r[3][i] * x + r[4][i] * y + r[5][i] * z;
      out[2][i] = r[6][i] * x + r[7][i] * y + r[8][i] * z;
    }
  }

  template <std::size_t N>
  static void put(Plane* planes, std::size_t i, const std::array<double, N>& entries) {
    for (std::size_t k = 0; k < N; ++k) planes[k][i] = entries[k];
  }

  static Mat rotation_of(const std::array<double, 4>& q) {
    const auto [w, x, y, z] = q;
    const double square = w * w + x * x + y * y + z * z;
    if (!(square > 0)) return {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double s = 2 / square;
    return {1 - s * (y * y + z * z), s * (x * y - w * z),     s * (x * z + w * y),
            s * (x * y + w * z),     1 - s * (x * x + z * z), s * (y * z - w * x),
            s * (x * z - w * y),     s * (y * z + w * x),     1 - s * (x * x + y * y)};
  }
};

Stitcher::Stitcher(const Stitching& stitching, RowForm form, base::WorkerPool& pool)
    : stitching_(stitching),
      form_(form),
      pool_(pool),
      loads_(3 * stitching_.triangles.size()),
      pinned_(stitching_.pinned),
      pin_targets_(stitching_.pins.size()),
      right_(stitching_.vertices()),
      positions_(stitching_.vertices()) {
  assert(form != RowForm::positions && !has_moments(form));
}

void Stitcher::set_shares(const Shares& shares) {
  pinned_.shares.clear();
  for (std::size_t i = 0; i < (shares.empty() ? 0 : stitching_.pins.size()); ++i)
    pinned_.shares.push_back(shares[stitching_.pins[i].vertex]);
}

void Stitcher::run(const Rows& rows, std::span<const double> sums, std::span<const Vec3> held,
                   sym3::Method method, int iterations) {
  base::Stopwatch watch;
  loads_ms_ = solve_ms_ = 0;
  place_pins(rows, method);
  load_blended(sums, method, iterations > 1);
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

// Where the handle alone would take the vertex.
void Stitcher::place_pins(const Rows& rows, sym3::Method method) {
  const std::size_t columns = rows.columns(), n = pin_targets_.size();
  std::vector<double> sums(n * columns);
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(rows.values.begin() + std::ptrdiff_t(stitching_.pins[i].handle * columns), columns,
                sums.begin() + std::ptrdiff_t(i * columns));
  share_sums(pinned_, pinned_.shares, rows.form, 0, n, sums);
  place_sums(pinned_, rows.form, sums, {0, 0, 0}, method, pin_targets_);
}

// The loads of a triangle's corners sum to 0.
inline void Stitcher::set_load(std::size_t t, const Vec3& a, const Vec3& b) {
  loads_[3 * t] = a, loads_[3 * t + 1] = b, loads_[3 * t + 2] = Vec3{0, 0, 0} - (a + b);
}

void Stitcher::load_blended(std::span<const double> sums, sym3::Method method, bool keep_stretches) {
  if (keep_stretches) stretched_.resize(stitching_.triangles.size());
  pool_.for_blocks(stitching_.triangles.size(), triangles_per_block, [&](std::size_t begin, std::size_t end) {
    const auto triangles = std::span(stitching_.triangles).subspan(begin, end - begin);
    const std::size_t count = triangles.size();
    Maps maps;
    maps.average(sums, form_, triangles);
    maps.make(form_, count, method, keep_stretches);
    alignas(64) Maps::Plane gradients[6], stretched[6], loads[6];
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [a, b] = stitching_.gradients[begin + i];
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

// R = the rotation nearest to sum_i x'_i (S g_i)^T maximises tr R^T sum_i x'_i (S g_i)^T, which is how the
// energy of the triangle depends on R.
void Stitcher::load_refitted() {
  pool_.for_blocks(stitching_.triangles.size(), triangles_per_block, [&](std::size_t begin, std::size_t end) {
    std::array<Mat, triangles_per_block> rotations;
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = stitching_.triangles[t];
      const Vec3 u = positions_[a] - positions_[c], v = positions_[b] - positions_[c];
      const auto& [su, sv] = stretched_[t];
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t k = 0; k < 3; ++k) rotations[t - begin][3 * r + k] = u[r] * su[k] + v[r] * sv[k];
      }
    }
    const sym3::MatView<double> view{sym3::Layout::packed, rotations[0].data()};
    sym3::polar(view, view, end - begin);
    for (std::size_t t = begin; t < end; ++t)
      set_load(t, image(rotations[t - begin], stretched_[t][0]),
               image(rotations[t - begin], stretched_[t][1]));
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

}  // namespace viete::deform
