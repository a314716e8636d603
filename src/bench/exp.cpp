#include "bench/exp.h"

#include <cstdio>

#include "base/quantity.h"
#include "bench/table.h"
#include "sym3/view.h"

namespace viete::bench {

namespace {

using sym3::Layout;

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
