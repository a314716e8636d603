#include "bench/exp.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cstdio>
#include <unsupported/Eigen/MatrixFunctions>

#include "base/text.h"
#include "bench/ensembles.h"
#include "bench/matrix_array.h"
#include "bench/table.h"
#include "sym3/eigen.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"

namespace viete::bench {

namespace {

using sym3::Method;
using sym3::Sym3;

template <Method method, class T>
Sym3<T> by(const Sym3<T>& s) {
  return sym3::exp(s, method);
}

template <class T>
Sym3<T> by_direct(const Sym3<T>& s) {
  using Matrix = Eigen::Matrix<T, 3, 3>;
  Eigen::SelfAdjointEigenSolver<Matrix> solver;
  solver.computeDirect(sym3::to_eigen(s));
  const Matrix& v = solver.eigenvectors();
  return sym3::from_eigen<T>(v * solver.eigenvalues().array().exp().matrix().asDiagonal() * v.transpose());
}

template <class T>
Sym3<T> by_pade(const Sym3<T>& s) {
  return sym3::from_eigen<T>(Eigen::Matrix<T, 3, 3>(sym3::to_eigen(s).exp()));
}

template <Method method>
ExpMethod by_method() {
  return {sym3::label(method).data(), by<method, double>, by<method, float>};
}

const ExpMethod methods[] = {
    by_method<Method::diag>(),        {"Direct", by_direct<double>, by_direct<float>},
    by_method<Method::sd>(),          by_method<Method::improved_sd_faithful>(),
    by_method<Method::improved_sd>(), {"Pade", by_pade<double>, by_pade<float>},
    by_method<Method::fast>(),
};

}  // namespace

std::span<const ExpMethod> exp_methods() {
  return methods;
}

namespace {

using sym3::Layout;

constexpr std::array layouts = {Layout::planes, Layout::blocks, Layout::packed, Layout::full};
constexpr std::size_t distinct = 1 << 16;  // matrices, repeated for larger counts
constexpr std::size_t window = 1024;       // batch of the slow methods, small enough to exclude memory time

/// The window of matrices of this round.
template <class T>
std::span<const Sym3<T>> turn(const std::vector<Sym3<T>>& matrices, std::size_t round) {
  return std::span(matrices).subspan(round % (matrices.size() / window) * window, window);
}

template <class T>
RoundCase slow_case(const std::vector<Sym3<T>>& matrices, std::vector<Sym3<T>>& out, Method method) {
  return {std::string(sym3::name(method)), window,
          [&, method](std::size_t round) { sym3::exp<T>(turn(matrices, round), out, method); }};
}

template <class T>
std::vector<BenchResult> measure_methods(const std::vector<Sym3<T>>& matrices, std::size_t count,
                                         base::Progress& progress) {
  MatrixArray<T> in(Layout::packed, count), result(Layout::packed, count);
  in.fill(matrices), result.fill(matrices);
  std::vector<Sym3<T>> out(window);
  std::vector<RoundCase> cases;
  for (const Method m : {Method::diag, Method::sd, Method::improved_sd})
    cases.push_back(slow_case(matrices, out, m));
  cases.push_back({"fast", count, [&](std::size_t) { sym3::exp(in.view(), result.view(), count); }});
  cases.push_back({"copy", count, [&](std::size_t) { in.copy_to(result); }});
  return measure_rounds(cases, 21, progress);
}

template <class T>
LayoutResult measure_layout(const std::vector<Sym3<T>>& matrices, Layout layout, std::size_t count,
                            base::Progress& progress) {
  MatrixArray<T> in(layout, count), result(layout, count);
  in.fill(matrices), result.fill(matrices);
  std::vector<Sym3<T>> out(window);
  // Short runs are repeated to exceed the clock resolution, after one run to fill the cache.
  const std::size_t times = std::max<std::size_t>(1, 200'000 / count);
  const auto repeated = [=](auto once) {
    return [=](std::size_t) {
      for (std::size_t i = 0; i < times; ++i) once();
    };
  };
  const std::vector<RoundCase> cases = {
      {"fast", count * times, repeated([&] { sym3::exp(in.view(), result.view(), count); })},
      {"copy", count * times, repeated([&] { in.copy_to(result); })},
      slow_case(matrices, out, Method::diag),
      slow_case(matrices, out, Method::improved_sd)};
  const auto results = measure_rounds(cases, count > 1'000'000 ? 7 : 21, progress);
  return {layout,
          count,
          results[0].ns_per_item,
          results[1].ns_per_item,
          results[2].ns_per_item,
          results[3].ns_per_item};
}

std::vector<std::size_t> sizes_up_to(std::size_t count) {
  std::vector<std::size_t> sizes;
  for (std::size_t size = 1024; size < count; size *= 4) sizes.push_back(size);
  if (sizes.size() > 1 && 2 * sizes.back() > count) sizes.pop_back();
  sizes.push_back(count);
  return sizes;
}

template <class T>
void measure(ExpBench& bench, base::Progress& progress) {
  const auto matrices = ensembles::paper_ensemble<T>(distinct);
  const auto sizes = sizes_up_to(bench.count);
  const double steps = static_cast<double>(1 + layouts.size() * sizes.size());
  double step = 0;
  const auto next = [&] {
    progress.section(step / steps, (step + 1) / steps);
    ++step;
  };
  next();
  bench.methods = measure_methods(matrices, bench.count, progress);
  for (const Layout layout : layouts) {
    for (const std::size_t size : sizes) {
      next();
      bench.layouts.push_back(measure_layout(matrices, layout, size, progress));
    }
  }
}

/// The shortest time among sizes that fit the second-level cache.
double best_in_cache(const ExpBench& bench) {
  double best = bench.layouts.front().fast;
  for (const LayoutResult& r : bench.layouts) {
    if (r.count <= 4096) best = std::min(best, r.fast);
  }
  return best;
}

// Rows that are not methods keep their own name.
std::string shown_name(const std::string& name) {
  const auto method = sym3::method_from_name(name);
  return method ? std::string(sym3::label(*method)) : name;
}

}  // namespace

ExpBench measure_exp(std::size_t count, bool in_float, base::Progress& progress) {
  ExpBench bench = {count, in_float, std::string(sym3::kernel_name()), {}, {}};
  in_float ? measure<float>(bench, progress) : measure<double>(bench, progress);
  return bench;
}

std::vector<ExpBar> bars_of(const ExpBench& bench) {
  std::vector<ExpBar> bars;
  for (const BenchResult& r : bench.methods)
    bars.push_back({shown_name(r.name), r.ns_per_item, r.name == sym3::name(Method::fast)});
  bars.push_back({"Fast, in cache", best_in_cache(bench), true});
  return bars;
}

namespace {

const char* precision(const ExpBench& bench) {
  return bench.in_float ? "float" : "double";
}

}  // namespace

const char* layout_name(sym3::Layout layout) {
  constexpr const char* names[] = {"planes", "blocks", "packed", "full"};
  return names[static_cast<std::size_t>(layout)];
}

void print(const ExpBench& bench) {
  print_table("exp: " + base::with_thousands(bench.count) + " matrices S = M M^T, " + precision(bench) +
                  ", one thread, kernel " + bench.kernel,
              bench.methods, "diag", "copy");
  std::printf(
      "\nfast by layout and size, each against the others in the same run\n\n"
      "| layout | matrices |  fast ns |  copy ns | x copy | diag / it | improved_sd / it |\n"
      "|--------|---------:|---------:|---------:|-------:|----------:|-----------------:|\n");
  for (const LayoutResult& r : bench.layouts) {
    std::printf("| %-6s | %8zu | %8.2f | %8.2f | %6.2f | %9.1f | %16.1f |\n", layout_name(r.layout), r.count,
                r.fast, r.copy, r.fast / r.copy, r.diag / r.fast, r.improved_sd / r.fast);
  }
}

nlohmann::json to_json(const ExpBench& bench) {
  nlohmann::json layouts = nlohmann::json::array();
  for (const LayoutResult& r : bench.layouts) {
    layouts.push_back({{"layout", layout_name(r.layout)},
                       {"count", r.count},
                       {"fast", r.fast},
                       {"copy", r.copy},
                       {"diag", r.diag},
                       {"improved_sd", r.improved_sd}});
  }
  return {{"figure", "exp"},
          {"count", bench.count},
          {"precision", precision(bench)},
          {"kernel", bench.kernel},
          {"results", to_json(bench.methods)},
          {"layouts", std::move(layouts)}};
}

Plot plot_of(const ExpBench& bench) {
  Plot plot;
  plot.title = "exp of symmetric 3x3 matrices";
  plot.subtitle = std::string("S = M M^T, ") + precision(bench) + ", one thread, kernel " + bench.kernel +
                  ", " + processor_name();
  plot.bars_title = base::with_thousands(bench.count) + " matrices from memory, ns a matrix";
  for (const ExpBar& bar : bars_of(bench)) {
    const char* color = bar.name == "copy" ? plot_color::copy : color_of_method(bar.name);
    plot.bars.push_back({bar.name, bar.ns, bar.ours ? plot_color::ours[0] : color});
  }
  plot.curves_title = "ns a matrix against size, by layout";
  const auto curve = [&](const std::string& name, const char* color, bool dashed, Layout layout,
                         double LayoutResult::*time) {
    plot.curves.push_back({name, color, dashed, {}});
    for (const LayoutResult& r : bench.layouts) {
      if (r.layout == layout) plot.curves.back().points.push_back({static_cast<double>(r.count), r.*time});
    }
  };
  for (const Layout layout : {Layout::planes, Layout::blocks, Layout::packed, Layout::full}) {
    const char* color = plot_color::ours[static_cast<std::size_t>(layout)];
    curve(std::string("Fast, ") + layout_name(layout), color, false, layout, &LayoutResult::fast);
    curve(std::string("copy, ") + layout_name(layout), color, true, layout, &LayoutResult::copy);
  }
  curve("Diag", plot_color::reference, false, Layout::packed, &LayoutResult::diag);
  curve("Improved SD", plot_color::rival, false, Layout::packed, &LayoutResult::improved_sd);
  return plot;
}

}  // namespace viete::bench
