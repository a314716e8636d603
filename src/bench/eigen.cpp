#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <vector>

#include "base/text.h"
#include "bench/ensembles.h"
#include "bench/exp.h"
#include "bench/table.h"
#include "sym3/eigen.h"
#include "sym3/eigenvalues.h"

namespace viete::bench {

namespace {

using Matrix = sym3::Sym3<double>;
using Values = std::array<double, 3>;

constexpr std::size_t piece = 100'000;  // matrices per round

Values eigenvalues_direct(const Matrix& s) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(sym3::to_eigen(s), Eigen::EigenvaluesOnly);
  return {solver.eigenvalues()[0], solver.eigenvalues()[1], solver.eigenvalues()[2]};
}

}  // namespace

EigenBench measure_eigen(std::size_t count, base::Progress& progress) {
  const auto in = ensembles::paper_ensemble<double>(count);
  std::vector<Values> out(count);
  std::vector<Matrix> copied(count);
  const std::size_t size = std::min(piece, count), pieces = count / size;
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
                          plot_color::ours[0], plot_color::copy};
  for (std::size_t i = 0; i < bench.results.size(); ++i) {
    plot.bars.push_back({bench.results[i].name, bench.results[i].ns_per_item, colors[i]});
  }
  return plot;
}

}  // namespace viete::bench
