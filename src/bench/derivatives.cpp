#include "bench/derivatives.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/child_program.h"
#include "base/error.h"
#include "base/progress.h"
#include "bench/ensembles.h"
#include "bench/matrix_array.h"
#include "bench/table.h"
#include "sym3/derivative.h"
#include "sym3/eigen.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"
#include "sym3/log.h"

namespace viete::bench {

namespace {

using namespace ensembles;
using sym3::SymView;

constexpr std::size_t matrices_in_cache = 1024;  // with six directions and their results: 640 KB in double
constexpr double pow_exponent = 0.4;

/// A function with its derivative in planes, and as numbers for the reference formula.
template <class T>
struct Differentiable {
  std::string name;
  void (*function)(const SymView<const T>&, const SymView<T>&, std::size_t);
  void (*derivative)(const SymView<const T>&, sym3::Directions<T>, sym3::Derivatives<T>, std::size_t);
  void (*tangent)(const SymView<const T>&, const sym3::TangentView<T>&, std::size_t);
  T (*at)(T), (*slope_at)(T);
};

template <class T>
std::vector<Differentiable<T>> differentiable() {
  using Views = const SymView<const T>&;
  using Out = const SymView<T>&;
  using Directions = sym3::Directions<T>;
  using Derivatives = sym3::Derivatives<T>;
  using Tangents = const sym3::TangentView<T>&;
  return {{"exp", [](Views s, Out f, std::size_t n) { sym3::exp(s, f, n); },
           [](Views s, Directions e, Derivatives f, std::size_t n) { sym3::exp_derivative(s, e, f, n); },
           [](Views s, Tangents f, std::size_t n) { sym3::exp_tangent(s, f, n); },
           [](T x) { return std::exp(x); }, [](T x) { return std::exp(x); }},
          {"log", [](Views s, Out f, std::size_t n) { sym3::log(s, f, n); },
           [](Views s, Directions e, Derivatives f, std::size_t n) { sym3::log_derivative(s, e, f, n); },
           [](Views s, Tangents f, std::size_t n) { sym3::log_tangent(s, f, n); },
           [](T x) { return std::log(x); }, [](T x) { return 1 / x; }},
          {"sqrt", [](Views s, Out f, std::size_t n) { sym3::sqrt(s, f, n); },
           [](Views s, Directions e, Derivatives f, std::size_t n) { sym3::sqrt_derivative(s, e, f, n); },
           [](Views s, Tangents f, std::size_t n) { sym3::sqrt_tangent(s, f, n); },
           [](T x) { return std::sqrt(x); }, [](T x) { return T(0.5) / std::sqrt(x); }},
          {"pow", [](Views s, Out f, std::size_t n) { sym3::pow(s, pow_exponent, f, n); },
           [](Views s, Directions e, Derivatives f, std::size_t n) {
             sym3::pow_derivative(s, pow_exponent, e, f, n);
           },
           [](Views s, Tangents f, std::size_t n) { sym3::pow_tangent(s, pow_exponent, f, n); },
           [](T x) { return std::pow(x, T(pow_exponent)); },
           [](T x) { return T(pow_exponent) * std::pow(x, T(pow_exponent - 1)); }}};
}

/// The usual method of finite element codes: eigenvectors by QR, divided differences of the function, its
/// derivative for eigenvalues closer than a millionth.
template <class T>
void by_eigenvectors(const Differentiable<T>& f, const sym3::Sym3<T>& s,
                     std::span<const sym3::Sym3<T>> directions, std::span<sym3::Sym3<T>> out) {
  using Matrix = Eigen::Matrix<T, 3, 3>;
  Eigen::SelfAdjointEigenSolver<Matrix> solver;
  solver.compute(sym3::to_eigen(s));
  const auto& x = solver.eigenvalues();
  const Matrix& v = solver.eigenvectors();
  const std::array<T, 3> values = {f.at(x[0]), f.at(x[1]), f.at(x[2])};
  Matrix slopes;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const T gap = x[i] - x[j];
      slopes(i, j) = std::abs(gap) > T(1e-6) ? (values[i] - values[j]) / gap : f.slope_at((x[i] + x[j]) / 2);
    }
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Matrix in_axes = v.transpose() * sym3::to_eigen(directions[k]) * v;
    out[k] = sym3::from_eigen<T>(v * slopes.cwiseProduct(in_axes) * v.transpose());
  }
}

/// Matrices, six directions for each, and space for the results, in planes.
template <class T>
struct Planes {
  std::vector<sym3::Sym3<T>> matrices, directions;
  std::vector<MatrixArray<T>> arrays;  // matrices, six of directions, six of results
  std::vector<SymView<const T>> from;
  std::vector<SymView<T>> to;
  sym3::TangentView<T> tangents;

  explicit Planes(const std::vector<sym3::Sym3<T>>& s)
      : matrices(s), directions(uniform_entries<T>(-1, 1, 6 * s.size())) {
    for (int k = 0; k < 13; ++k) arrays.emplace_back(sym3::Layout::planes, s.size());
    arrays[0].fill(s);
    std::array<T*, 36> all;
    for (std::size_t k = 0; k < 6; ++k) {
      arrays[1 + k].fill(std::span(directions).subspan(k * s.size(), s.size()));
      from.push_back(arrays[1 + k].view()), to.push_back(arrays[7 + k].view());
      std::copy_n(to[k].plane, 6, all.begin() + 6 * k);
    }
    tangents = sym3::TangentView<T>(all);
  }
};

/// Returns the time per direction.
template <class T>
double time_derivative(const Differentiable<T>& f, const std::string& type, Planes<T>& p, Bars& report) {
  const std::size_t count = p.matrices.size();
  const SymView<const T> s(p.arrays[0].view());
  std::array<sym3::Sym3<T>, 6> answers;
  const auto peer = [&](std::size_t n) {
    for (std::size_t i = 0; i < count; ++i) {
      by_eigenvectors<T>(f, p.matrices[i], std::span(p.directions).subspan(6 * i, n),
                         std::span(answers).first(n));
    }
  };
  constexpr std::size_t often = 20;
  const auto repeated = [&](auto call) {
    return [call](std::size_t) {
      for (std::size_t i = 0; i < often; ++i) call();
    };
  };
  const auto derive = [&](std::size_t n) {
    return repeated([&, n] { f.derivative(s, std::span(p.from).first(n), std::span(p.to).first(n), count); });
  };
  const std::vector<RoundCase> cases = {
      {"function", often * count, repeated([&] { f.function(s, p.to[0], count); })},
      {"1 direction", often * count, derive(1)},
      {"6 directions", often * count, derive(6)},
      {"tangent", often * count, repeated([&] { f.tangent(s, p.tangents, count); })},
      {"eigenvectors 1", count, [&](std::size_t) { peer(1); }},
      {"eigenvectors 6", count, [&](std::size_t) { peer(6); }},
      {"copy", often * count, repeated([&] { p.arrays[0].copy_to(p.arrays[7]); })}};
  base::Progress progress;
  const auto r = measure_rounds(cases, 41, progress);
  const std::string what = "derivative of " + f.name + " " + type;
  print_table(what + ", planes in the second cache, ns per matrix", r, "eigenvectors 1", "copy");
  const auto ratio = [&](const char* slow, const char* fast) { return time_of(r, slow) / time_of(r, fast); };
  report.check(what + ", one direction: / function", ratio("1 direction", "function"), 3, false);
  report.check(what + ", six directions: / function", ratio("6 directions", "function"), 8, false);
  report.check(what + ", tangent: / function", ratio("tangent", "function"), 8, false);
  return time_of(r, "1 direction");
}

/// ns per matrix of SciPy's expm_frechet, one direction, if /usr/bin/python3 has SciPy.
std::optional<double> time_of_scipy() {
  constexpr const char* program = R"(
import sys, time
import numpy
from scipy.linalg import expm_frechet
random = numpy.random.default_rng(1)
m, e = random.uniform(-1, 1, (2, 500, 3, 3))
s, e = m @ m.swapaxes(1, 2), e + e.swapaxes(1, 2)
for pair in zip(s[:20], e): expm_frechet(*pair, compute_expm=False)
start = time.process_time()
for pair in zip(s, e): expm_frechet(*pair, compute_expm=False)
print((time.process_time() - start) / len(s) * 1e9, file=sys.stderr)
)";
  try {
    base::ChildProgram python({"/usr/bin/python3", "-c", program}, "", {"OPENBLAS_NUM_THREADS=1"});
    python.finish();
    return std::stod(python.said());
  } catch (const base::Error&) {
    return std::nullopt;
  }
}

void compare_with_scipy(double ours) {
  if (const auto ns = time_of_scipy()) {
    std::printf("  %-58s %8.0f\n", "scipy.linalg.expm_frechet, one direction: / ours", *ns / ours);
  } else {
    std::printf("  scipy.linalg.expm_frechet: SciPy is not installed for /usr/bin/python3\n");
  }
}

/// Difference between the eigenvector formula and ours (which tests verify) for nearly equal eigenvalues.
void print_differences(const Differentiable<double>& exp) {
  for (const double gap : {1e-2, 1e-4, 2e-6, 1e-7}) {
    const auto matrices = pairs<double>(gap, 2000), directions = uniform_entries<double>(-1, 1, 2000);
    double most = 0;
    for (std::size_t i = 0; i < matrices.size(); ++i) {
      sym3::Sym3<double> theirs;
      by_eigenvectors<double>(exp, matrices[i], std::span(directions).subspan(i, 1), std::span(&theirs, 1));
      const auto ours = sym3::to_eigen(sym3::exp_derivative(matrices[i], directions[i]));
      most = std::max(most, (sym3::to_eigen(theirs) - ours).norm() / ours.norm() / 0x1p-53);
    }
    std::printf("  eigenvectors, two eigenvalues %g apart: off by %.2g u\n", gap, most);
  }
}

template <class T>
void derivatives(const std::string& type, Bars& report) {
  // Positive definite with margin, for all functions; the paper's ensemble nearly is not.
  Random random(12);
  std::vector<sym3::Sym3<T>> matrices(matrices_in_cache);
  for (auto& s : matrices)
    s = with_eigenvalues<T>({uniform(random, 0.5, 3), uniform(random, 0.5, 3), uniform(random, 0.5, 3)},
                            random);
  Planes<T> planes(matrices);
  for (const auto& f : differentiable<T>()) {
    const double ns = time_derivative(f, type, planes, report);
    if constexpr (sizeof(T) == 8) {
      if (f.name == "exp") print_differences(f), compare_with_scipy(ns);
    }
  }
}

}  // namespace

void bench_derivatives(Bars& report) {
  derivatives<double>("double", report);
  derivatives<float>("float", report);
}

}  // namespace viete::bench
