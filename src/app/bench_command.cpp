// viete bench exp|eigen|frame: the paper's three figures, measured on this machine.
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "app/bench_table.h"
#include "app/command_line.h"
#include "app/frame_bench.h"
#include "sym3/eigenvalues.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"

namespace viete::app {

namespace {

using Matrix = sym3::Sym3<double>;
using sym3::Method;

struct BenchOptions {
  std::size_t count = 0;  ///< 0: the figure's own
  std::filesystem::path json;
};

constexpr std::array methods = {Method::diag, Method::sd, Method::improved_sd, Method::fast};
constexpr std::size_t pieces = 10;

// The paper's ensemble: S = M M^T, entries of M uniform in [-1, 1].
std::vector<Matrix> paper_ensemble(std::size_t count) {
  std::mt19937_64 random(20160101);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Matrix> matrices(count);
  for (auto& s : matrices) {
    double m[3][3];
    for (auto& row : m) {
      for (double& entry : row) entry = uniform(random);
    }
    const auto dot = [&](int i, int j) { return m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2]; };
    s = {dot(0, 0), dot(0, 1), dot(0, 2), dot(1, 1), dot(1, 2), dot(2, 2)};
  }
  return matrices;
}

std::size_t piece_size(std::size_t count) { return std::max<std::size_t>(1, count / pieces); }

std::string title(const char* what, std::size_t count) {
  return std::string(what) + ": " + std::to_string(count) + " matrices S = M M^T, double, one thread, kernel " +
         std::string(sym3::kernel_name());
}

int bench_exp(const BenchOptions& options) {
  const std::size_t size = piece_size(options.count ? options.count : 10'000'000), count = size * pieces;
  const std::vector<Matrix> in = paper_ensemble(count);
  std::vector<Matrix> out(count);
  const auto part = [&](std::size_t p) { return std::span(in).subspan(p * size, size); };
  const auto result = [&](std::size_t p) { return std::span(out).subspan(p * size, size); };
  std::vector<BenchCase> cases;
  for (const Method m : methods) {
    cases.push_back({std::string(sym3::name(m)), [=](std::size_t p) { sym3::exp<double>(part(p), result(p), m); }});
  }
  cases.push_back({"copy", [=](std::size_t p) { std::memcpy(result(p).data(), part(p).data(), size * sizeof(Matrix)); }});
  const auto results = interleave(cases, pieces, size, 2);
  print_table(title("exp", count), results, "diag", "copy");
  write_json(options.json, {{"figure", "exp"}, {"count", count}, {"results", to_json(results)}});
  return exit_ok;
}

int bench_eigen(const BenchOptions& options) {
  const std::size_t size = piece_size(options.count ? options.count : 10'000'000), count = size * pieces;
  const std::vector<Matrix> in = paper_ensemble(count);
  std::vector<std::array<double, 3>> out(count);
  std::vector<Matrix> copied(size);
  const auto each = [&](auto eigenvalues) {
    return [&, eigenvalues](std::size_t p) {
      for (std::size_t i = p * size; i < (p + 1) * size; ++i) out[i] = eigenvalues(in[i]);
    };
  };
  const std::vector<BenchCase> cases = {
      {"QR", each([](const Matrix& s) { return sym3::eigenvalues_qr(s); })},
      {"Viete", each([](const Matrix& s) { return sym3::eigenvalues_viete(s); })},
      {"copy", [&](std::size_t p) { std::memcpy(copied.data(), &in[p * size], size * sizeof(Matrix)); }}};
  const auto results = interleave(cases, pieces, size, 2);
  print_table(title("eigenvalues", count), results, "QR", "copy");
  write_json(options.json, {{"figure", "eigen"}, {"count", count}, {"results", to_json(results)}});
  return exit_ok;
}

}  // namespace

void add_bench_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("bench", "Measure: the paper's three figures on this machine");
  command->require_subcommand(1);
  const struct {
    const char* name;
    const char* text;
    const char* count;
    int (*run)(const BenchOptions&);
  } figures[] = {{"exp", "exp by method", "Matrices (default 10,000,000)", bench_exp},
                 {"eigen", "Eigenvalues by QR and by Viete's formula", "Matrices (default 10,000,000)", bench_eigen}};
  for (const auto& figure : figures) {
    auto* sub = command->add_subcommand(figure.name, figure.text);
    auto options = std::make_shared<BenchOptions>();
    sub->add_option("--count", options->count, figure.count)->check(CLI::PositiveNumber);
    sub->add_option("--json", options->json, "Also write the numbers to this file");
    sub->callback([options, &action, run = figure.run] { action = [options, run] { return run(*options); }; });
  }
  add_frame_bench(*command, action);
}

}  // namespace viete::app
