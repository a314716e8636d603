#include "bench/sym3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/derivatives.h"
#include "bench/ensembles.h"
#include "bench/table.h"
#include "deform/polar.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"
#include "sym3/log.h"
#include "sym3/polar.h"
#include "sym3/reference.h"
#include "sym3/rotation.h"

namespace viete::bench {

namespace {

using namespace ensembles;
using sym3::Kernel;
using sym3::Layout;
using sym3::Method;
using sym3::Sym3;
using sym3::View;

constexpr std::size_t in_cache = 4096;  // matrices: 400 KB in double, in and out
constexpr std::size_t pieces = 10;

/// Page-aligned numbers like large arrays, not yet written.
template <class T>
class Numbers {
public:
  explicit Numbers(std::size_t count)
      : data_(static_cast<T*>(std::aligned_alloc(4096, (count * sizeof(T) / 4096 + 1) * 4096))) {}
  T* get() const { return data_.get(); }

private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> data_;
};

/// The same matrices, repeated, in planes, blocks or nine.
template <class T>
void fill(const std::vector<Sym3<T>>& from, const View<T, 6>& to, std::size_t count) {
  constexpr std::size_t line = 64 / sizeof(T);
  constexpr int entry_of_nine[] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  for (std::size_t i = 0; i < count; ++i) {
    const T* e = &from[i % from.size()].xx;
    if (to.layout == Layout::planes) {
      for (int k = 0; k < 6; ++k) to.plane[k][i] = e[k];
    } else if (to.layout == Layout::blocks) {
      for (int k = 0; k < 6; ++k) to.plane[0][(i / line * 6 + k) * line + i % line] = e[k];
    } else {
      for (int k = 0; k < 9; ++k) to.plane[0][9 * i + k] = e[entry_of_nine[k]];
    }
  }
}

/// A measured case: run(i) does the i-th piece of the work.
struct BenchCase {
  std::string name;
  std::function<void(std::size_t piece)> run;
  std::size_t repeats = 1;  ///< repetitions, for short cases
};

/// Runs `parts` pieces of `size` matrices each in turn, `passes` times.
std::vector<BenchResult> measure(const std::string& title, const std::vector<BenchCase>& cases,
                                 std::size_t parts, std::size_t size, std::size_t passes,
                                 const std::string& reference) {
  std::vector<RoundCase> rounds;
  for (const BenchCase& c : cases) {
    rounds.push_back({c.name, size * c.repeats, [&c, parts](std::size_t round) {
                        for (std::size_t i = 0; i < c.repeats; ++i) c.run(round % parts);
                      }});
  }
  base::Progress progress;
  const auto results = measure_rounds(rounds, parts * passes, progress);
  print_table(title, results, reference, "copy");
  return results;
}

double faster(const std::vector<BenchResult>& results, const std::string& slow, const std::string& fast) {
  return time_of(results, slow) / time_of(results, fast);
}

/// Planes that fit the second-level cache.
template <class T>
void in_second_cache(const std::string& type, Bars& report) {
  const auto matrices = paper_ensemble<T>(in_cache);
  const std::size_t stride = sym3::padded_stride<T>(in_cache);
  const Numbers<T> in(6 * stride), out(6 * stride);
  const View<T, 6> from(in.get(), stride), to(out.get(), stride);
  fill(matrices, from, in_cache);
  std::vector<Sym3<T>> answers(in_cache);
  std::vector<BenchCase> cases;
  for (const Method m : {Method::diag, Method::improved_sd}) {
    cases.push_back(
        {std::string(sym3::name(m)), [&, m](std::size_t) { sym3::exp<T>(matrices, answers, m); }});
  }
  cases.push_back({"one by one", [&](std::size_t) {
                     for (std::size_t i = 0; i < in_cache; ++i) answers[i] = sym3::exp(matrices[i]);
                   }});
  // Repeated, because a processor runs wide instructions slowly for the first 20 us or so.
  for (const Kernel& k : sym3::kernels()) {
    cases.push_back({std::string(k.name),
                     [&, kernel = &k](std::size_t) { sym3::exp(from, to, in_cache, {kernel}); }, 100});
  }
  cases.push_back(
      {"copy", [&](std::size_t) { std::memcpy(out.get(), in.get(), 6 * stride * sizeof(T)); }, 100});
  const auto r =
      measure("exp " + type + ", planes in the second cache, ns per matrix", cases, 1, in_cache, 41, "diag");
  const bool is_double = sizeof(T) == 8;
  if (sym3::kernel_from_name("avx512")) {
    report.check("exp " + type + ", in cache, avx512: diag /", faster(r, "diag", "avx512"),
                 is_double ? 110 : 200, true);
    report.check("exp " + type + ", in cache, avx512: improved_sd /", faster(r, "improved_sd", "avx512"),
                 is_double ? 30 : 75, true);
  } else {
    std::printf("  this machine has no AVX-512: its rows are skipped\n");
  }
  if (is_double && sym3::kernel_from_name("avx2")) {
    report.check("exp double, in cache, avx2: diag /", faster(r, "diag", "avx2"), 80, true);
    report.check("exp double, in cache, avx2: improved_sd /", faster(r, "improved_sd", "avx2"), 22, true);
  }
  if (is_double) {
    report.check("one matrix per call: diag /", faster(r, "diag", "one by one"), 14, true);
    report.check("one matrix per call: improved_sd /", faster(r, "improved_sd", "one by one"), 4, true);
  }
}

/// One layout from memory, compared with a copy of it piece by piece.
template <class T>
std::vector<BenchResult> from_memory(const std::string& title, Layout layout, std::size_t count) {
  const std::size_t size = std::max<std::size_t>(64, count / pieces / 64 * 64), total = size * pieces;
  const std::size_t width = layout == Layout::full ? 9 : 6, stride = sym3::padded_stride<T>(total);
  const Numbers<T> in(width * stride), out(width * stride);
  const auto view = [&](T* data) {
    return layout == Layout::planes ? View<T, 6>(data, stride) : View<T, 6>(layout, data);
  };
  const auto part = [=](View<T, 6> v, std::size_t p) {
    for (int k = 0; k < 6; ++k) {
      if (v.plane[k]) v.plane[k] += p * size * (layout == Layout::planes ? 1 : width);
    }
    return v;
  };
  const auto matrices = paper_ensemble<T>(in_cache);
  fill(matrices, view(in.get()), total);
  std::memset(out.get(), 0, width * stride * sizeof(T));
  std::vector<Sym3<T>> answers(in_cache);
  const std::vector<BenchCase> cases = {
      {"diag",
       [&](std::size_t) {
         for (std::size_t i = 0; i < size; i += in_cache) sym3::exp<T>(matrices, answers, Method::diag);
       }},
      {"fast",
       [&](std::size_t p) {
         sym3::exp(part(view(in.get()), p), part(view(out.get()), p), size,
                   {nullptr, nullptr, sym3::Stores::automatic});
       }},
      {"copy", [&](std::size_t p) {
         const auto from = part(view(in.get()), p), to = part(view(out.get()), p);
         if (layout != Layout::planes)
           return void(std::memcpy(to.plane[0], from.plane[0], width * size * sizeof(T)));
         for (int k = 0; k < 6; ++k) std::memcpy(to.plane[k], from.plane[k], size * sizeof(T));
       }}};
  return measure(title + ", " + std::to_string(total) + " from memory", cases, pieces, size, 2, "diag");
}

void out_of_cache(std::size_t count, Bars& report) {
  const auto best = [](const auto& a, const auto& b) {
    return std::min(1 / faster(a, "copy", "fast"), 1 / faster(b, "copy", "fast"));
  };
  const auto planes = from_memory<double>("exp double, planes", Layout::planes, count);
  const auto blocks = from_memory<double>("exp double, blocks", Layout::blocks, count);
  report.check("exp double, from memory, best layout: / copy", best(planes, blocks), 1.25, false);
  const auto planes_f = from_memory<float>("exp float, planes", Layout::planes, count);
  const auto blocks_f = from_memory<float>("exp float, blocks", Layout::blocks, count);
  report.check("exp float, from memory, best layout: / copy", best(planes_f, blocks_f), 1.15, false);
  const auto full = from_memory<double>("exp of Matrix3d", Layout::full, count);
  report.check("exp of Matrix3d, from memory: diag /", faster(full, "diag", "fast"), 60, true);
  report.check("exp of Matrix3d, from memory: / copy", 1 / faster(full, "copy", "fast"), 1.3, false);
}

/// R = cos a I + sin a / a [w] + (1 - cos a) / a^2 w w^T, with a case for small angles.
sym3::Mat3<double> textbook_rotation(const sym3::Vec3<double>& w) {
  const double a2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2], a = std::sqrt(a2);
  const double c = std::cos(a), s = a > 1e-8 ? std::sin(a) / a : 1, f = a > 1e-8 ? (1 - c) / a2 : 0.5;
  const auto [x, y, z] = w;
  return {c + f * x * x,     f * x * y - s * z, f * x * z + s * y, f * x * y + s * z, c + f * y * y,
          f * y * z - s * x, f * x * z - s * y, f * y * z + s * x, c + f * z * z};
}

/// w = a / (2 sin a) times the antisymmetric part of R, cos a = (tr R - 1) / 2, with a case for small angles;
/// inaccurate near half turns.
sym3::Vec3<double> textbook_log(const sym3::Mat3<double>& r) {
  const double a = std::acos(std::clamp((r[0] + r[4] + r[8] - 1) / 2, -1.0, 1.0));
  const double f = a > 1e-8 ? a / (2 * std::sin(a)) : 0.5;
  return {f * (r[7] - r[5]), f * (r[2] - r[6]), f * (r[3] - r[1])};
}

/// By the quaternion's largest component and the arc tangent of half the angle; accurate at every angle.
sym3::Vec3<double> log_by_quaternion(const sym3::Mat3<double>& r) {
  const double x = r[0], y = r[4], z = r[8], trace = x + y + z;
  const double dx = r[7] - r[5], dy = r[2] - r[6], dz = r[3] - r[1], sx = r[7] + r[5], sy = r[2] + r[6],
               sz = r[3] + r[1];
  std::array<double, 4> q;
  if (trace >= std::max({x, y, z}))
    q = {1 + trace, dx, dy, dz};
  else if (x >= std::max(y, z))
    q = {dx, 1 + x - y - z, sz, sy};
  else if (y >= z)
    q = {dy, sz, 1 + y - x - z, sx};
  else
    q = {dz, sy, sx, 1 + z - x - y};
  const double sine = std::copysign(std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), q[0]);
  const double f = sine != 0 ? 2 * std::atan2(std::fabs(sine), std::fabs(q[0])) / sine : 0;
  return {f * q[1], f * q[2], f * q[3]};
}

void rotation_logs(Bars& report) {
  Random random(8);
  const std::size_t stride = sym3::padded_stride<double>(in_cache);
  std::vector<sym3::Mat3<double>> r(in_cache);
  std::vector<sym3::Vec3<double>> w(in_cache);
  const Numbers<double> planes(9 * stride), out(3 * stride);
  for (std::size_t i = 0; i < in_cache; ++i) {
    r[i] =
        sym3::exp_rotation<double>({uniform(random, -3, 3), uniform(random, -3, 3), uniform(random, -3, 3)});
    for (int k = 0; k < 9; ++k) planes.get()[k * stride + i] = r[i][k];
  }
  const sym3::VecView<double> to(out.get(), stride);
  const auto a = measure(
      "logs of rotations double, planes in the second cache",
      {{"textbook", [&](std::size_t) { std::transform(r.begin(), r.end(), w.begin(), textbook_log); }},
       {"by quaternion",
        [&](std::size_t) { std::transform(r.begin(), r.end(), w.begin(), log_by_quaternion); }},
       {"one by one",
        [&](std::size_t) { std::transform(r.begin(), r.end(), w.begin(), sym3::log_rotation<double>); }},
       {"batched",
        [&](std::size_t) { sym3::log_rotation(sym3::MatView<double>(planes.get(), stride), to, in_cache); },
        20},
       {"copy", [&](std::size_t) { std::memcpy(out.get(), planes.get(), 3 * stride * sizeof(double)); }, 20}},
      1, in_cache, 41, "textbook");
  report.check("log of rotations: textbook / batched", faster(a, "textbook", "batched"), 6, true);
}

void rotations(Bars& report) {
  Random random(7);
  const std::size_t stride = sym3::padded_stride<double>(in_cache);
  std::vector<sym3::Vec3<double>> w(in_cache);
  std::vector<sym3::Mat3<double>> r(in_cache), m(in_cache);
  const Numbers<double> planes_w(3 * stride), planes_m(9 * stride), out(9 * stride);
  for (std::size_t i = 0; i < in_cache; ++i) {
    for (int k = 0; k < 3; ++k) planes_w.get()[k * stride + i] = w[i][k] = uniform(random, -1.5, 1.5);
    const auto turn = sym3::exp_rotation(w[i]);
    for (int k = 0; k < 9; ++k)
      planes_m.get()[k * stride + i] = m[i][k] = turn[k] + uniform(random, -0.3, 0.3);
  }
  const sym3::MatView<double> to(out.get(), stride);
  const auto a = measure(
      "rotations double, planes in the second cache",
      {{"textbook", [&](std::size_t) { std::transform(w.begin(), w.end(), r.begin(), textbook_rotation); }},
       {"batched",
        [&](std::size_t) { sym3::exp_rotation(sym3::VecView<double>(planes_w.get(), stride), to, in_cache); },
        20},
       {"copy", [&](std::size_t) { std::memcpy(out.get(), planes_m.get(), 6 * stride * sizeof(double)); },
        20}},
      1, in_cache, 41, "textbook");
  report.check("rotation: textbook / batched", faster(a, "textbook", "batched"), 15, true);
  const auto b = measure(
      "polar double, rotations with stretches of some 30 %, planes",
      {{"SVD",
        [&](std::size_t) {
          std::transform(m.begin(), m.end(), r.begin(),
                         [](const auto& x) { return deform::polar(x).rotation; });
        }},
       {"batched",
        [&](std::size_t) { sym3::polar(sym3::MatView<double>(planes_m.get(), stride), to, in_cache); }, 4},
       {"copy", [&](std::size_t) { std::memcpy(out.get(), planes_m.get(), 9 * stride * sizeof(double)); },
        20}},
      1, in_cache, 21, "SVD");
  report.check("polar: SVD / batched", faster(b, "SVD", "batched"), 40, true);
}

void logarithms(const std::string& what, const std::vector<Sym3<double>>& matrices, Bars& report) {
  const std::size_t stride = sym3::padded_stride<double>(in_cache);
  const Numbers<double> in(6 * stride), out(6 * stride);
  const View<double, 6> from(in.get(), stride), to(out.get(), stride);
  fill(matrices, from, in_cache);
  std::vector<Sym3<double>> answers(in_cache);
  const auto r = measure(
      "log double, " + what + ", planes in the second cache",
      {{"QR",
        [&](std::size_t) {
          std::transform(matrices.begin(), matrices.end(), answers.begin(), sym3::log_qr<double>);
        }},
       {"one by one",
        [&](std::size_t) {
          std::transform(matrices.begin(), matrices.end(), answers.begin(), sym3::log<double>);
        }},
       {"batched", [&](std::size_t) { sym3::log(from, to, in_cache); }, 4},
       {"copy", [&](std::size_t) { std::memcpy(out.get(), in.get(), 6 * stride * sizeof(double)); }, 20}},
      1, in_cache, 41, "QR");
  report.check("log, " + what + ": QR / batched", faster(r, "QR", "batched"), 20, true);
}

/// The largest relative error of exp in u, against 106 bits.
template <class T>
double worst_error(const std::vector<Sym3<T>>& matrices) {
  std::vector<Sym3<T>> answers(matrices.size());
  sym3::exp<T>(matrices, answers);
  double worst = 0;
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    const auto wide = [](const Sym3<T>& s) { return Sym3<double>{s.xx, s.xy, s.xz, s.yy, s.yz, s.zz}; };
    const double error = sym3::relative_error(wide(answers[i]), wide(matrices[i]));
    worst = std::isnan(error) ? INFINITY : std::max(worst, error);
  }
  return worst / (sizeof(T) == 8 ? 0x1p-53 : 0x1p-24);
}

template <class T>
void errors(const std::string& type, std::size_t count, Bars& report) {
  const bool fused = sym3::kernel().fused;
  report.check("exp " + type + ", error in u: the paper's ensemble, " + std::to_string(count),
               worst_error(paper_ensemble<T>(count)), fused ? 8 : 12, false);
  report.check("exp " + type + ", error in u: any gap, spread 3", worst_error(spreads<T>(3, -1, count / 10)),
               fused ? 6 : 15.5, false);
  for (const double spread : {10.0, 60.0}) {
    const double bar = fused ? 6 + 2 * spread : 8 + 2.5 * spread;
    report.check("exp " + type + ", error in u: spread " + std::to_string(int(spread)),
                 worst_error(spreads<T>(spread, -spread / 3, count / 50)), bar, false);
  }
}

}  // namespace

void bench_sym3(std::size_t count, const std::filesystem::path& json) {
  Bars report;
  const bool small = count != 0 && count < 1'000'000;
  std::printf("kernels:");
  for (const Kernel& k : sym3::kernels()) std::printf(" %s", std::string(k.name).c_str());
  std::printf("; running %s; one thread, its processor time, medians of interleaved runs\n",
              std::string(sym3::kernel_name()).c_str());
  in_second_cache<double>("double", report);
  in_second_cache<float>("float", report);
  out_of_cache(count ? count : 10'000'000, report);
  rotations(report);
  rotation_logs(report);
  Random random(11);
  std::vector<Sym3<double>> ordinary(in_cache);
  for (auto& s : ordinary)
    s = with_eigenvalues<double>({uniform(random, 1, 4), uniform(random, 1, 4), uniform(random, 1, 4)},
                                 random);
  logarithms("conditions up to 4", ordinary, report);
  logarithms("S = M M^T", paper_ensemble<double>(in_cache), report);
  bench_derivatives(report);
  errors<double>("double", small ? count : 1'000'000, report);
  errors<float>("float", small ? count : 1'000'000, report);
  write_json(json, {{"figure", "sym3"}, {"results", report.rows}});
}

}  // namespace viete::bench
