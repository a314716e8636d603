#include "bench/timing/exp.h"

#include <algorithm>
#include <array>

#include "bench/timing/ensembles.h"
#include "bench/timing/matrix_array.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"

namespace viete::bench {

namespace {

using sym3::Layout;
using sym3::Method;
using sym3::Sym3;

constexpr std::array layouts = {Layout::planes, Layout::blocks, Layout::packed, Layout::full};
constexpr std::size_t distinct = 1 << 16;  // matrices, repeated where more are asked for
constexpr std::size_t window = 1024;  // that the slow methods do at a time: their time is not the memory's

/// So many matrices of those at the round's turn.
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
  // Short runs are repeated until the clock can tell, and done once before, so that what fits is in the
  // cache.
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

/// The shortest time among what fits in the second cache.
double best_in_cache(const ExpBench& bench) {
  double best = bench.layouts.front().fast;
  for (const LayoutResult& r : bench.layouts) {
    if (r.count <= 4096) best = std::min(best, r.fast);
  }
  return best;
}

// What is no method is called by its own name.
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

}  // namespace viete::bench
