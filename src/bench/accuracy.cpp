#include "bench/accuracy.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text.h"
#include "bench/ensembles.h"
#include "bench/exp.h"
#include "sym3/reference.h"

namespace viete::bench {

namespace {

using Matrix = sym3::Sym3<double>;
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
    for (std::size_t m = 0; m < methods.size(); ++m) {
      add(row.cells[m], sym3::relative_error(rounded<double>(methods[m](in)), exact_in), samples);
    }
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
      for (std::size_t m = 0; m < row.cells.size(); ++m) {
        cells[exp_methods()[m].name] = {{"worst", row.cells[m].worst}, {"nan", row.cells[m].nan_share}};
      }
      rows.push_back({{"name", row.name}, {"value", row.value}, {"methods", std::move(cells)}});
    }
    json.push_back({{"title", table.title}, {"by", table.by}, {"rows", std::move(rows)}});
  }
  return json;
}

}  // namespace viete::bench
