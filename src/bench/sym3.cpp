#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "bench/ensembles.h"
#include "bench/exp.h"
#include "pose/maps.h"
#include "sym3/decomposition.h"
#include "sym3/derivative.h"
#include "sym3/eigen.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"
#include "sym3/log.h"
#include "sym3/polar.h"
#include "sym3/rotation.h"

namespace viete::bench {

namespace {

using namespace ensembles;
using sym3::Kernel;
using sym3::Layout;
using sym3::Method;
using sym3::Sym3;
using sym3::SymView;

constexpr std::size_t in_cache = 4096;  // number of matrices; input and output take 400 KB as doubles
const std::string planes_text = ", planes in the second cache, per matrix";

template <class In, class Out, class Function>
RoundCase one_by_one(const char* name, const std::vector<In>& in, std::vector<Out>& out, Function function) {
  return {name, in_cache,
          [&, function](std::size_t) { std::transform(in.begin(), in.end(), out.begin(), function); }};
}

RoundCase batched(const std::string& name, std::size_t repeats, const std::function<void()>& run) {
  return {name, in_cache, [run](std::size_t) { run(); }, repeats};
}

RoundCase copy_of(const double* from, double* to, std::size_t planes, std::size_t stride) {
  return batched("copy", 20, [=] { std::memcpy(to, from, planes * stride * sizeof(double)); });
}

std::vector<BenchResult> measure(const std::string& title, const std::vector<RoundCase>& cases) {
  base::Progress progress;
  const auto results = measure_rounds(cases, 41, progress);
  print(title + planes_text, times_table(results));
  return results;
}

template <class T>
void in_second_cache(const std::string& type, Bars& report) {
  const auto matrices = paper_ensemble<T>(in_cache);
  MatrixArray<T> in(Layout::planes, in_cache), out(Layout::planes, in_cache);
  in.fill(matrices);
  out.fill(matrices);
  std::vector<Sym3<T>> answers(in_cache);
  std::vector<RoundCase> cases;
  for (const Method m : {Method::diag, Method::improved_sd})
    cases.push_back(batched(std::string(sym3::name(m)), 1, [&, m] { sym3::exp<T>(matrices, answers, m); }));
  cases.push_back(one_by_one("one by one", matrices, answers, [](const Sym3<T>& s) { return sym3::exp(s); }));
  // Repeats each case, because processors run wide instructions slowly for about the first 20 us.
  for (const Kernel& k : sym3::kernels())
    cases.push_back(batched(std::string(k.name), 100,
                            [&, kernel = &k] { sym3::exp(in.view(), out.view(), in_cache, {kernel}); }));
  cases.push_back(batched("copy", 100, [&] { in.copy_to(out); }));
  const auto r = measure("exp " + type, cases);
  const struct {
    const char *slow, *fast;
    double bar, float_bar;  // 0 means no check
  } bars[] = {{"diag", "avx512", 110, 200},  {"improved_sd", "avx512", 30, 75},
              {"diag", "avx2", 80, 0},       {"improved_sd", "avx2", 22, 0},
              {"diag", "one by one", 14, 0}, {"improved_sd", "one by one", 4, 0}};
  for (const auto& [slow, fast, bar, float_bar] : bars) {
    const double least = sizeof(T) == 8 ? bar : float_bar;
    if (least > 0 && time_of(r, fast) > 0)
      report.check("exp " + type + ", in cache: " + slow + " / " + fast, faster(r, slow, fast), least, true);
  }
}

void out_of_cache(std::size_t count, Bars& report) {
  base::Progress progress;
  for (const bool in_float : {false, true}) {
    const LayoutResult r = measure_layout(Layout::planes, count, in_float, progress);
    report.check(std::string("exp ") + (in_float ? "float" : "double") + ", from memory, best layout: / copy",
                 faster(r.times, "fast", "copy"), in_float ? 1.15 : 1.25, false);
  }
  const LayoutResult full = measure_layout(Layout::full, count, false, progress);
  report.check("exp of Matrix3d, from memory: diag /", faster(full.times, "diag", "fast"), 60, true);
  report.check("exp of Matrix3d, from memory: / copy", faster(full.times, "fast", "copy"), 1.3, false);
}

/// Returns R = cos a * I + (sin a / a) W + (1 - cos a) / a^2 * w w^T, with W v = cross(w, v) and a = |w|.
sym3::Mat3<double> textbook_rotation(const sym3::Vec3<double>& w) {
  const double a2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2], a = std::sqrt(a2);
  const double c = std::cos(a), s = a > 1e-8 ? std::sin(a) / a : 1, f = a > 1e-8 ? (1 - c) / a2 : 0.5;
  const auto [x, y, z] = w;
  return {c + f * x * x,     f * x * y - s * z, f * x * z + s * y, f * x * y + s * z, c + f * y * y,
          f * y * z - s * x, f * x * z - s * y, f * y * z + s * x, c + f * z * z};
}

/// Returns a / (2 sin a) * (antisymmetric part of R) with cos a = (tr R - 1) / 2. Inaccurate near half turns.
sym3::Vec3<double> textbook_log(const sym3::Mat3<double>& r) {
  const double a = std::acos(std::clamp((r[0] + r[4] + r[8] - 1) / 2, -1.0, 1.0));
  const double f = a > 1e-8 ? a / (2 * std::sin(a)) : 0.5;
  return {f * (r[7] - r[5]), f * (r[2] - r[6]), f * (r[3] - r[1])};
}

void rotations(Bars& report) {
  Random random(7);
  const std::size_t stride = sym3::padded_stride<double>(in_cache);
  std::vector<sym3::Vec3<double>> w(in_cache), logs(in_cache);
  std::vector<sym3::Mat3<double>> r(in_cache), m(in_cache), turns(in_cache);
  base::AlignedVector<double> planes_w(3 * stride), planes_r(9 * stride), planes_m(9 * stride),
      out(9 * stride);
  for (std::size_t i = 0; i < in_cache; ++i) {
    for (int k = 0; k < 3; ++k) planes_w[k * stride + i] = w[i][k] = uniform(random, -1.5, 1.5);
    turns[i] = sym3::exp_rotation(w[i]);
    for (int k = 0; k < 9; ++k) {
      planes_r[k * stride + i] = turns[i][k];
      planes_m[k * stride + i] = m[i][k] = turns[i][k] + uniform(random, -0.3, 0.3);
    }
  }
  const sym3::VecView<double> from_w(planes_w.data(), stride), to_w(out.data(), stride);
  const sym3::MatView<double> from_r(planes_r.data(), stride), from_m(planes_m.data(), stride),
      to(out.data(), stride);
  const auto exps =
      measure("rotations double", {one_by_one("textbook", w, r, textbook_rotation),
                                   batched("batched", 20, [&] { sym3::exp_rotation(from_w, to, in_cache); }),
                                   copy_of(planes_m.data(), out.data(), 6, stride)});
  report.check("rotation: textbook / batched", faster(exps, "textbook", "batched"), 15, true);
  const auto back = measure("logs of rotations double",
                            {one_by_one("textbook", turns, logs, textbook_log),
                             one_by_one("one by one", turns, logs, sym3::log_rotation<double>),
                             batched("batched", 20, [&] { sym3::log_rotation(from_r, to_w, in_cache); }),
                             copy_of(planes_r.data(), out.data(), 3, stride)});
  report.check("log of rotations: textbook / batched", faster(back, "textbook", "batched"), 6, true);
  const auto polar = measure("polar double, rotations with stretches of some 30 %",
                             {one_by_one("SVD", m, r, [](const auto& x) { return pose::polar(x).rotation; }),
                              batched("batched", 4, [&] { sym3::polar(from_m, to, in_cache); }),
                              copy_of(planes_m.data(), out.data(), 9, stride)});
  report.check("polar: SVD / batched", faster(polar, "SVD", "batched"), 40, true);
}

/// Times eigenvectors and singular value decompositions against Eigen's solvers.
template <class T>
void decompositions(const std::string& type, Bars& report) {
  using Matrix = Eigen::Matrix<T, 3, 3>;
  const auto symmetric = paper_ensemble<T>(in_cache);
  Random random(13);
  const std::size_t stride = sym3::padded_stride<T>(in_cache);
  MatrixArray<T> s(Layout::planes, in_cache);
  s.fill(symmetric);
  std::vector<Matrix> general(in_cache), answers(in_cache);
  base::AlignedVector<T> m(9 * stride), u(9 * stride), v(9 * stride), values(3 * stride);
  for (std::size_t i = 0; i < in_cache; ++i)
    for (int k = 0; k < 9; ++k) m[k * stride + i] = general[i](k / 3, k % 3) = T(uniform(random, -1, 1));
  const sym3::MatView<T> to_u(u.data(), stride), to_v(v.data(), stride);
  const sym3::VecView<T> to_values(values.data(), stride);
  const auto solved = [](auto compute) {
    return [compute](const Sym3<T>& a) {
      Eigen::SelfAdjointEigenSolver<Matrix> solver;
      compute(solver, sym3::to_eigen(a));
      return solver.eigenvectors();
    };
  };
  std::vector<RoundCase> eigh = {
      one_by_one("QR", symmetric, answers, solved([](auto& e, const Matrix& a) { e.compute(a); })),
      one_by_one("direct", symmetric, answers, solved([](auto& e, const Matrix& a) { e.computeDirect(a); }))};
  std::vector<RoundCase> svd = {one_by_one("JacobiSVD", general, answers, [](const Matrix& a) {
    const Eigen::JacobiSVD<Matrix> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return Matrix(svd.matrixU() * svd.matrixV());
  })};
  for (const Kernel& k : sym3::kernels()) {
    eigh.push_back(batched(std::string(k.name), 20,
                           [&, kernel = &k] { sym3::eigh(s.view(), to_values, to_v, in_cache, {kernel}); }));
    svd.push_back(batched(std::string(k.name), 10, [&, kernel = &k] {
      sym3::svd(sym3::MatView<T>(m.data(), stride), to_u, to_values, to_v, in_cache, {kernel});
    }));
  }
  const auto vectors = measure("eigenvectors " + type, eigh), singular = measure("svd " + type, svd);
  if (!(time_of(vectors, "avx512") > 0)) return;
  report.check("eigenvectors " + type + ": QR / avx512", faster(vectors, "QR", "avx512"),
               sizeof(T) == 8 ? 15 : 25, true);
  report.check("svd " + type + ": JacobiSVD / avx512", faster(singular, "JacobiSVD", "avx512"),
               sizeof(T) == 8 ? 14 : 20, true);
}

void logarithms(const std::string& what, const std::vector<Sym3<double>>& matrices, Bars& report) {
  MatrixArray<double> in(Layout::planes, in_cache), out(Layout::planes, in_cache);
  in.fill(matrices);
  out.fill(matrices);
  std::vector<Sym3<double>> answers(in_cache);
  const auto r = measure("log double, " + what,
                         {one_by_one("QR", matrices, answers, sym3::log_qr<double>),
                          one_by_one("one by one", matrices, answers, sym3::log<double>),
                          batched("batched", 4, [&] { sym3::log(in.view(), out.view(), in_cache); }),
                          batched("copy", 20, [&] { in.copy_to(out); })});
  report.check("log, " + what + ": QR / batched", faster(r, "QR", "batched"), 20, true);
}

constexpr std::size_t matrices_in_cache = 1024;  // 640 KB as doubles, with six directions and results
constexpr double pow_exponent = 0.4;

/// Computes derivatives as usual in finite element codes: by eigenvectors (QR) and divided differences. For
/// eigenvalues closer than 1e-6, uses the derivative of the function instead.
template <class T>
void by_eigenvectors(T (*value_at)(T), T (*slope_at)(T), const Sym3<T>& s,
                     std::span<const Sym3<T>> directions, std::span<Sym3<T>> out) {
  using Matrix = Eigen::Matrix<T, 3, 3>;
  Eigen::SelfAdjointEigenSolver<Matrix> solver;
  solver.compute(sym3::to_eigen(s));
  const auto& x = solver.eigenvalues();
  const Matrix& v = solver.eigenvectors();
  const std::array<T, 3> values = {value_at(x[0]), value_at(x[1]), value_at(x[2])};
  Matrix slopes;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const T gap = x[i] - x[j];
      slopes(i, j) = std::abs(gap) > T(1e-6) ? (values[i] - values[j]) / gap : slope_at((x[i] + x[j]) / 2);
    }
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Matrix in_axes = v.transpose() * sym3::to_eigen(directions[k]) * v;
    out[k] = sym3::from_eigen<T>(v * slopes.cwiseProduct(in_axes) * v.transpose());
  }
}

template <class T>
struct Planes {
  std::vector<Sym3<T>> matrices, directions;
  std::vector<MatrixArray<T>> arrays;  // matrices, six arrays of directions, six of results
  std::vector<SymView<const T>> from;
  std::vector<SymView<T>> to;
  sym3::TangentView<T> tangents;

  explicit Planes(const std::vector<Sym3<T>>& s)
      : matrices(s), directions(uniform_entries<T>(-1, 1, 6 * s.size())) {
    for (int k = 0; k < 13; ++k) arrays.emplace_back(sym3::Layout::planes, s.size());
    arrays[0].fill(s);
    std::array<T*, 36> all;
    for (std::size_t k = 0; k < 6; ++k) {
      arrays[1 + k].fill(std::span(directions).subspan(k * s.size(), s.size()));
      from.push_back(arrays[1 + k].view());
      to.push_back(arrays[7 + k].view());
      std::copy_n(to[k].plane, 6, all.begin() + 6 * k);
    }
    tangents = sym3::TangentView<T>(all);
  }
};

template <class T, class Function, class Derivative, class Tangent>
void time_derivative(const std::string& what, T (*value_at)(T), T (*slope_at)(T), Planes<T>& p, Bars& report,
                     Function function, Derivative derivative, Tangent tangent) {
  const std::size_t count = p.matrices.size();
  const SymView<const T> s(p.arrays[0].view());
  std::array<Sym3<T>, 6> answers;
  const auto peer = [&](std::size_t n) {
    return [&, n](std::size_t) {
      for (std::size_t i = 0; i < count; ++i)
        by_eigenvectors<T>(value_at, slope_at, p.matrices[i], std::span(p.directions).subspan(6 * i, n),
                           std::span(answers).first(n));
    };
  };
  constexpr std::size_t often = 20;
  const auto derive = [&](std::size_t n) {
    return [&, n](std::size_t) {
      derivative(s, sym3::Directions<T>(p.from).first(n), sym3::Derivatives<T>(p.to).first(n), count);
    };
  };
  const auto r =
      measure(what, {{"eigenvectors 1", count, peer(1)},
                     {"function", count, [&](std::size_t) { function(s, p.to[0], count); }, often},
                     {"1 direction", count, derive(1), often},
                     {"6 directions", count, derive(6), often},
                     {"tangent", count, [&](std::size_t) { tangent(s, p.tangents, count); }, often},
                     {"eigenvectors 6", count, peer(6)},
                     {"copy", count, [&](std::size_t) { p.arrays[0].copy_to(p.arrays[7]); }, often}});
  report.check(what + ", one direction: / function", faster(r, "1 direction", "function"), 3, false);
  report.check(what + ", six directions: / function", faster(r, "6 directions", "function"), 8, false);
  report.check(what + ", tangent: / function", faster(r, "tangent", "function"), 8, false);
}

template <class T>
void derivatives(const std::string& type, Bars& report) {
  // All functions need positive definite matrices. The paper's ensemble can be nearly singular.
  Random random(12);
  std::vector<Sym3<T>> matrices(matrices_in_cache);
  for (auto& s : matrices)
    s = with_eigenvalues<T>({uniform(random, 0.5, 3), uniform(random, 0.5, 3), uniform(random, 0.5, 3)},
                            random);
  Planes<T> planes(matrices);
  const auto time = [&](const char* name, T (*value_at)(T), T (*slope_at)(T), auto... functions) {
    time_derivative<T>(std::string("derivative of ") + name + " " + type, value_at, slope_at, planes, report,
                       functions...);
  };
  time(
      "exp", [](T x) { return std::exp(x); }, [](T x) { return std::exp(x); },
      [](auto... a) { sym3::exp(a...); }, [](auto... a) { sym3::exp_derivative(a...); },
      [](auto... a) { sym3::exp_tangent(a...); });
  time(
      "log", [](T x) { return std::log(x); }, [](T x) { return 1 / x; }, [](auto... a) { sym3::log(a...); },
      [](auto... a) { sym3::log_derivative(a...); }, [](auto... a) { sym3::log_tangent(a...); });
  time(
      "sqrt", [](T x) { return std::sqrt(x); }, [](T x) { return T(0.5) / std::sqrt(x); },
      [](auto... a) { sym3::sqrt(a...); }, [](auto... a) { sym3::sqrt_derivative(a...); },
      [](auto... a) { sym3::sqrt_tangent(a...); });
  time(
      "pow", [](T x) { return std::pow(x, T(pow_exponent)); },
      [](T x) { return T(pow_exponent) * std::pow(x, T(pow_exponent - 1)); },
      [](auto s, auto... a) { sym3::pow(s, pow_exponent, a...); },
      [](auto s, auto... a) { sym3::pow_derivative(s, pow_exponent, a...); },
      [](auto s, auto... a) { sym3::pow_tangent(s, pow_exponent, a...); });
}

/// Returns the largest error of exp relative to 106-bit results, in units of the roundoff u.
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
  std::printf("; running %s; processor time of one thread, medians of interleaved runs\n",
              std::string(sym3::kernel_name()).c_str());
  in_second_cache<double>("double", report);
  in_second_cache<float>("float", report);
  out_of_cache(count ? count : 10'000'000, report);
  rotations(report);
  decompositions<double>("double", report);
  decompositions<float>("float", report);
  Random random(11);
  std::vector<Sym3<double>> ordinary(in_cache);
  for (auto& s : ordinary)
    s = with_eigenvalues<double>({uniform(random, 1, 4), uniform(random, 1, 4), uniform(random, 1, 4)},
                                 random);
  logarithms("conditions up to 4", ordinary, report);
  logarithms("S = M M^T", paper_ensemble<double>(in_cache), report);
  derivatives<double>("double", report);
  derivatives<float>("float", report);
  errors<double>("double", small ? count : 1'000'000, report);
  errors<float>("float", small ? count : 1'000'000, report);
  write_json(json, {{"figure", "sym3"}, {"results", report.rows}});
}

}  // namespace viete::bench
