#include "bench/exp.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <unsupported/Eigen/MatrixFunctions>

#include "base/text.h"
#include "bench/ensembles.h"
#include "sym3/decomposition.h"
#include "sym3/eigen.h"
#include "sym3/eigenvalues.h"
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

using sym3::Layout;

constexpr std::array layouts = {Layout::planes, Layout::packed, Layout::full};
constexpr std::size_t distinct = 1 << 16;  // number of different matrices; larger arrays repeat them
constexpr std::size_t window = 1024;       // matrices per round of slow methods; few enough for the cache

template <class T>
std::span<const Sym3<T>> turn(const std::vector<Sym3<T>>& matrices, std::size_t round) {
  return std::span(matrices).subspan(round % (matrices.size() / window) * window, window);
}

template <class T>
LayoutResult time_layout(const std::vector<Sym3<T>>& matrices, Layout layout, std::size_t count,
                         base::Progress& progress) {
  MatrixArray<T> in(layout, count), result(layout, count);
  in.fill(matrices);
  result.fill(matrices);
  std::vector<Sym3<T>> out(window);
  const std::size_t often = std::max<std::size_t>(1, 200'000 / count);
  std::vector<RoundCase> cases;
  for (const Method m : {Method::diag, Method::sd, Method::improved_sd})
    cases.push_back({std::string(sym3::name(m)), window,
                     [&, m](std::size_t round) { sym3::exp<T>(turn(matrices, round), out, m); }});
  cases.push_back({"fast", count, [&](std::size_t) { sym3::exp(in.view(), result.view(), count); }, often});
  cases.push_back({"copy", count, [&](std::size_t) { in.copy_to(result); }, often});
  const std::size_t rounds = count > 1'000'000 && layout != Layout::packed ? 7 : 21;
  return {layout, count, measure_rounds(cases, rounds, progress)};
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
  const double steps = static_cast<double>(layouts.size() * sizes.size());
  for (const Layout layout : layouts) {
    for (const std::size_t size : sizes) {
      const auto step = static_cast<double>(bench.layouts.size());
      progress.section(step / steps, (step + 1) / steps);
      bench.layouts.push_back(time_layout(matrices, layout, size, progress));
    }
    if (layout == Layout::packed) bench.methods = bench.layouts.back().times;
  }
}

double best_in_cache(const ExpBench& bench) {
  double best = time_of(bench.layouts.front().times, "fast");
  for (const LayoutResult& r : bench.layouts)
    if (r.count <= 4096) best = std::min(best, time_of(r.times, "fast"));
  return best;
}

std::string shown_name(const std::string& name) {
  const auto method = sym3::method_from_name(name);
  return method ? std::string(sym3::label(*method)) : name;
}

const char* precision(const ExpBench& bench) {
  return bench.in_float ? "float" : "double";
}

const char* layout_name(Layout layout) {
  constexpr const char* names[] = {"planes", "packed", "full"};
  return names[static_cast<std::size_t>(layout)];
}

}  // namespace

std::span<const ExpMethod> exp_methods() {
  return methods;
}

LayoutResult measure_layout(sym3::Layout layout, std::size_t count, bool in_float, base::Progress& progress) {
  return in_float ? time_layout(ensembles::paper_ensemble<float>(distinct), layout, count, progress)
                  : time_layout(ensembles::paper_ensemble<double>(distinct), layout, count, progress);
}

ExpBench measure_exp(std::size_t count, bool in_float, base::Progress& progress) {
  ExpBench bench = {count, in_float, std::string(sym3::kernel_name()), {}, {}};
  in_float ? measure<float>(bench, progress) : measure<double>(bench, progress);
  return bench;
}

std::vector<BenchResult> labelled_times(const ExpBench& bench) {
  std::vector<BenchResult> times;
  for (const BenchResult& r : bench.methods) times.push_back({shown_name(r.name), r.ns_per_item});
  times.push_back({"Fast, in cache", best_in_cache(bench)});
  return times;
}

Table layouts_table(const ExpBench& bench) {
  Table table{{"layout", "matrices", "Fast, ns", "copy, ns", "Diag, ns", "Improved SD, ns"}, {}};
  for (const LayoutResult& r : bench.layouts) {
    table.rows.push_back({layout_name(r.layout), base::with_thousands(r.count)});
    for (const char* name : {"fast", "copy", "diag", "improved_sd"})
      table.rows.back().push_back(base::few_digits(time_of(r.times, name)));
  }
  return table;
}

void print(const ExpBench& bench) {
  print("exp: " + base::with_thousands(bench.count) + " matrices S = M M^T, " + precision(bench) +
            ", one thread, kernel " + bench.kernel,
        times_table(labelled_times(bench)));
  print("by layout and size, all measured in the same run", layouts_table(bench));
}

nlohmann::json to_json(const ExpBench& bench) {
  nlohmann::json layouts = nlohmann::json::array();
  for (const LayoutResult& r : bench.layouts) {
    layouts.push_back({{"layout", layout_name(r.layout)}, {"count", r.count}});
    for (const BenchResult& time : r.times) layouts.back()[time.name] = time.ns_per_item;
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
  for (const BenchResult& r : labelled_times(bench)) {
    const bool ours = r.name.starts_with("Fast");
    const char* color = r.name == "copy" ? plot_color::copy : color_of_method(r.name);
    plot.bars.push_back({r.name, r.ns_per_item, ours ? plot_color::ours[0] : color});
  }
  const auto curve = [&](const std::string& name, const char* color, bool dashed, Layout layout,
                         const char* time) {
    plot.curves.push_back({name, color, dashed, {}});
    for (const LayoutResult& r : bench.layouts)
      if (r.layout == layout)
        plot.curves.back().points.push_back({static_cast<double>(r.count), time_of(r.times, time)});
  };
  for (const Layout layout : layouts) {
    const char* color = plot_color::ours[static_cast<std::size_t>(layout)];
    curve(std::string("Fast, ") + layout_name(layout), color, false, layout, "fast");
    curve(std::string("copy, ") + layout_name(layout), color, true, layout, "copy");
  }
  curve("Diag", plot_color::reference, false, Layout::packed, "diag");
  curve("Improved SD", plot_color::rival, false, Layout::packed, "improved_sd");
  return plot;
}

namespace {

using Matrix = Sym3<double>;
using Values = std::array<double, 3>;

constexpr std::size_t piece = 100'000;  // matrices per round

Values eigenvalues_direct(const Matrix& s) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(sym3::to_eigen(s), Eigen::EigenvaluesOnly);
  return {solver.eigenvalues()[0], solver.eigenvalues()[1], solver.eigenvalues()[2]};
}

/// Returns a function that computes eigenvectors with Eigen's solver. `compute` chooses its algorithm.
template <class Compute>
auto eigenvectors_by(Compute compute) {
  return [compute](const Matrix& s) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    compute(solver, sym3::to_eigen(s));
    return solver.eigenvectors();
  };
}

}  // namespace

EigenBench measure_eigen(std::size_t count, base::Progress& progress) {
  const auto in = ensembles::paper_ensemble<double>(count);
  std::vector<Values> out(count);
  std::vector<Matrix> copied(count);
  const std::size_t size = std::min(piece, count), pieces = count / size;
  std::vector<Eigen::Matrix3d> vectors(size);
  const auto each_vector = [&](auto eigenvectors) {
    return [&, eigenvectors](std::size_t round) {
      const std::size_t begin = round % pieces * size;
      for (std::size_t i = 0; i < size; ++i) vectors[i] = eigenvectors(in[begin + i]);
    };
  };
  const auto each = [&](auto eigenvalues) {
    return [&, eigenvalues](std::size_t round) {
      const std::size_t begin = round % pieces * size;
      for (std::size_t i = begin; i < begin + size; ++i) out[i] = eigenvalues(in[i]);
    };
  };
  const std::vector<RoundCase> cases = {
      {"QR", size, each([](const Matrix& s) { return sym3::eigenvalues_qr(s); })},
      {"Direct", size, each(eigenvalues_direct)},
      {"Viete", size, each([](const Matrix& s) { return sym3::eigenvalues_viete(s); })},
      {"Fast", size,
       [&](std::size_t round) {
         const std::size_t begin = round % pieces * size;
         sym3::eigenvalues(sym3::packed(&in[begin]), {sym3::Layout::packed, out[begin].data()}, size);
       }},
      {"QR, vectors", size, each_vector(eigenvectors_by([](auto& e, const auto& a) { e.compute(a); }))},
      {"Direct, vectors", size,
       each_vector(eigenvectors_by([](auto& e, const auto& a) { e.computeDirect(a); }))},
      {"Fast, vectors", size,
       [&](std::size_t round) {
         const std::size_t begin = round % pieces * size;
         sym3::eigh(sym3::packed(&in[begin]), {sym3::Layout::packed, out[begin].data()},
                    {sym3::Layout::packed, vectors[0].data()}, size);
       }},
      {"copy", size, [&](std::size_t round) {
         const auto begin = static_cast<std::ptrdiff_t>(round % pieces * size);
         std::copy_n(in.begin() + begin, size, copied.begin() + begin);
       }}};
  return {count, measure_rounds(cases, std::max<std::size_t>(pieces, 21), progress)};
}

void print(const EigenBench& bench) {
  print("eigenvalues: " + base::with_thousands(bench.count) + " matrices S = M M^T, double, one thread",
        times_table(bench.results));
}

nlohmann::json to_json(const EigenBench& bench) {
  return {{"figure", "eigen"}, {"count", bench.count}, {"results", to_json(bench.results)}};
}

Plot plot_of(const EigenBench& bench) {
  Plot plot;
  const char* colors[] = {plot_color::reference, plot_color::reference, plot_color::rival,
                          plot_color::ours[0],   plot_color::reference, plot_color::reference,
                          plot_color::ours[0],   plot_color::copy};
  for (std::size_t i = 0; i < bench.results.size(); ++i)
    plot.bars.push_back({bench.results[i].name, bench.results[i].ns_per_item, colors[i]});
  return plot;
}

namespace {

using Matrices = std::vector<Matrix>;

// If this function were inline, GCC 12 would vectorise the conversions and omit a rounding.
template <class To, class From>
[[gnu::noinline]] sym3::Sym3<To> rounded(const sym3::Sym3<From>& s) {
  const auto to = [](From x) { return static_cast<To>(x); };
  return {to(s.xx), to(s.xy), to(s.xz), to(s.yy), to(s.yz), to(s.zz)};
}

using Make = std::function<Matrices(std::size_t count)>;

// Returns an ensemble like `from`, with each matrix s replaced by change(s).
template <class Change>
Make changed(const Make& from, Change change) {
  return [=](std::size_t count) {
    Matrices all = from(count);
    for (Matrix& s : all) s = change(s);
    return all;
  };
}

struct Ensemble {
  std::string name;
  double value;
  Make make;
};

struct Plan {
  std::string title, by;
  std::vector<Ensemble> ensembles;
};

template <class Make>
Plan by_value(std::string title, std::string by, const std::vector<double>& values, Make make) {
  Plan plan = {std::move(title), std::move(by), {}};
  for (const double v : values) {
    plan.ensembles.push_back(
        {base::formatted("%.3g", v), v, [make, v](std::size_t count) { return make(v, count); }});
  }
  return plan;
}

Plan ensembles_plan() {
  const Make paper = [](std::size_t n) { return ensembles::paper_ensemble<double>(n); };
  const auto entries = [](double low, double high) -> Make {
    return [=](std::size_t n) { return ensembles::uniform_entries<double>(low, high, n); };
  };
  const auto shifted = [](double by) {
    return [=](const Matrix& s) { return Matrix{s.xx + by, s.xy, s.xz, s.yy + by, s.yz, s.zz + by}; };
  };
  return {"by ensemble",
          "ensemble",
          {{"paper: M M^T", 0, paper},
           {"entries in [0, 3]", 0, entries(0, 3)},
           {"entries in [-1, 1]", 0, entries(-1, 1)},
           {"diagonal, [-3, 3]", 0,
            changed(entries(-3, 3), [](const Matrix& s) { return Matrix{s.xx, 0, 0, s.yy, 0, s.zz}; })},
           {"rank one, v v^T", 0,  // 0 is a double eigenvalue
            changed(entries(-1, 1),
                    [](const Matrix& s) {
                      const double x = s.xx, y = s.xy, z = s.xz;
                      return Matrix{x * x, x * y, x * z, y * y, y * z, z * z};
                    })},
           {"multiples of I", 0,
            changed(entries(-3, 3), [](const Matrix& s) { return Matrix{s.xx, 0, 0, s.xx, 0, s.xx}; })},
           {"zero", 0, [](std::size_t n) { return Matrices(n); }},
           {"M M^T + 20 I", 0, changed(paper, shifted(20))},
           {"M M^T - 80 I", 0, changed(paper, shifted(-80))}}};
}

std::vector<Plan> plans(bool in_float) {
  const std::vector<double> gaps = {1e-1, 1e-2, 1e-3,  1e-4,  1e-5,  1.01e-6, 1e-6,
                                    1e-7, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16};
  std::vector<double> sizes = {0.1, 1, 3, 4.9, 6, 10, 20, 50, 100, 300, 600};
  if (in_float) std::erase_if(sizes, [](double s) { return s > 100; });  // larger spreads overflow
  return {
      ensembles_plan(),
      by_value("two close eigenvalues, the third anywhere in [0, 3]", "gap", gaps, ensembles::pairs<double>),
      by_value("three close eigenvalues, in [0, 3]", "gap", gaps, ensembles::triples<double>),
      by_value(
          "by spread: largest minus smallest eigenvalue, half of them with close ones", "spread", sizes,
          [](double spread, std::size_t n) { return ensembles::spreads<double>(spread, -spread / 2, n); }),
      by_value("by scale, entries uniform in [-scale, scale]", "scale",
               {1e-300, 1e-16, 1e-12, 1e-8, 1e-4, 1e-2, 1, 10}, [](double scale, std::size_t n) {
                 return ensembles::uniform_entries<double>(-scale, scale, n);
               })};
}

void add(Accuracy& accuracy, double error, std::size_t samples) {
  if (std::isfinite(error)) {
    accuracy.worst = std::max(accuracy.worst, error);
  } else {
    accuracy.nan_share += 1 / static_cast<double>(samples);
  }
}

template <class T>
AccuracyTable::Row measured(const Ensemble& ensemble, std::size_t samples, base::Progress& progress) {
  const auto methods = exp_methods();
  AccuracyTable::Row row = {ensemble.name, ensemble.value, std::vector<Accuracy>(methods.size())};
  const Matrices matrices = ensemble.make(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const auto in = rounded<T>(matrices[i]);
    const Matrix exact_in = rounded<double>(in);
    for (std::size_t m = 0; m < methods.size(); ++m)
      add(row.cells[m], sym3::relative_error(rounded<double>(methods[m](in)), exact_in), samples);
    progress.report(static_cast<double>(i) / static_cast<double>(samples));
  }
  return row;
}

std::string cell(const Accuracy& accuracy) {
  std::string text = accuracy.nan_share < 1 ? error_text(accuracy.worst) : "";
  if (accuracy.nan_share > 0)
    text += (text.empty() ? "NaN " : ", NaN ") + percent(std::max(1.0, 100 * accuracy.nan_share));
  return text;
}

}  // namespace

std::vector<AccuracyTable> measure_accuracy(std::size_t samples, bool in_float, base::Progress& progress) {
  std::vector<AccuracyTable> tables;
  const std::vector<Plan> all = plans(in_float);
  std::size_t total = 0, row = 0;
  for (const Plan& plan : all) total += plan.ensembles.size();
  for (const Plan& plan : all) {
    tables.push_back({plan.title, plan.by, {}});
    for (const Ensemble& ensemble : plan.ensembles) {
      const auto whole = static_cast<double>(total);
      progress.section(static_cast<double>(row) / whole, static_cast<double>(row + 1) / whole);
      tables.back().rows.push_back(in_float ? measured<float>(ensemble, samples, progress)
                                            : measured<double>(ensemble, samples, progress));
      ++row;
    }
  }
  return tables;
}

Table errors_table(const AccuracyTable& accuracy) {
  Table table{{accuracy.by}, {}};
  for (const ExpMethod& method : exp_methods()) table.columns.emplace_back(method.name);
  for (const auto& row : accuracy.rows) {
    table.rows.push_back({row.name});
    for (const Accuracy& a : row.cells) table.rows.back().push_back(cell(a));
  }
  return table;
}

nlohmann::json to_json(const std::vector<AccuracyTable>& tables) {
  nlohmann::json json = nlohmann::json::array();
  for (const AccuracyTable& table : tables) {
    nlohmann::json rows = nlohmann::json::array();
    for (const auto& row : table.rows) {
      nlohmann::json cells = nlohmann::json::object();
      for (std::size_t m = 0; m < row.cells.size(); ++m)
        cells[exp_methods()[m].name] = {{"worst", row.cells[m].worst}, {"nan", row.cells[m].nan_share}};
      rows.push_back({{"name", row.name}, {"value", row.value}, {"methods", std::move(cells)}});
    }
    json.push_back({{"title", table.title}, {"by", table.by}, {"rows", std::move(rows)}});
  }
  return json;
}

}  // namespace viete::bench
