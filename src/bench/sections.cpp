#include "bench/sections.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "bench/exp.h"
#include "bench/figures.h"
#include "bench/html.h"
#include "bench/modes_table.h"
#include "bench/plot.h"
#include "sym3/exp.h"

namespace viete::bench {

namespace {

using base::few_digits;
using sym3::Method;

std::string error_cell(const Accuracy& a) {
  std::string text = a.nan_share < 1 ? error_text(a.worst) : "";
  if (a.nan_share > 0) text += (text.empty() ? "NaN " : ", NaN ") + percent(std::max(1.0, 100 * a.nan_share));
  return text;
}

HtmlTable errors_table(const AccuracyTable& accuracy) {
  HtmlTable table{{accuracy.by}, {}};
  for (const ExpMethod& method : exp_methods()) table.columns.emplace_back(method.name);
  for (const auto& row : accuracy.rows) {
    table.rows.push_back({row.name});
    for (const Accuracy& a : row.cells) table.rows.back().push_back(error_cell(a));
  }
  return table;
}

// Errors of the four methods, without scales so small that all matrices are zero by rounding.
std::string errors_plot(const AccuracyTable& accuracy) {
  constexpr double least = 1e-20;
  Plot plot;
  plot.across = accuracy.by;
  const auto methods = exp_methods();
  for (const Method m : {Method::diag, Method::sd, Method::improved_sd, Method::fast}) {
    const auto at =
        std::ranges::find(methods, sym3::label(m), [](const auto& e) { return std::string_view(e.name); });
    PlotCurve curve{at->name, color_of_method(at->name), false, {}};
    for (const auto& row : accuracy.rows)
      if (row.value >= least)
        curve.points.push_back({row.value, row.cells[static_cast<std::size_t>(at - methods.begin())].worst});
    std::ranges::sort(curve.points, {}, &PlotCurve::Point::count);
    plot.curves.push_back(std::move(curve));
  }
  return draw_curves(plot);
}

struct ErrorsOf {
  const char* what;
  std::size_t table;
};

std::string error_plots(const Figures& figures) {
  constexpr ErrorsOf plots[] = {{"Two eigenvalues close to each other", 1},
                                {"Three eigenvalues close to each other", 2},
                                {"By spread, the largest less the smallest eigenvalue", 3},
                                {"By scale of the entries", 4}};
  std::string text;
  for (const auto& [what, table] : plots) {
    text += "<h3>" + escaped(what) + "</h3>\n<div class=\"plots\">";
    text += figure("largest relative error, double", errors_plot(figures.accuracy[table]));
    text +=
        figure("largest relative error, float", errors_plot(figures.accuracy_in_float[table])) + "</div>\n";
  }
  return text;
}

std::string error_tables(const char* precision, const std::vector<AccuracyTable>& tables) {
  std::string text = std::string("<details><summary>All errors, in ") + precision + "</summary>\n";
  for (const AccuracyTable& table : tables)
    text += paragraph(table.title, "note") + html(errors_table(table));
  return text + "</details>\n";
}

std::string frames_seen(const Figures& figures) {
  std::string seen = "There is not enough memory for the plain frame.";
  const FrameTime* plain = frame_of(figures.frames, frame_names::reference, usual_faces);
  const FrameTime* ours = frame_of(figures.frames, frame_names::compressed, usual_faces);
  const FrameTime* dragged = frame_of(figures.frames, frame_names::dragged, usual_faces);
  if (!ours) ours = frame_of(figures.frames, frame_names::dense, usual_faces);
  if (plain && ours && dragged)
    seen = "In a cage of " + std::to_string(usual_faces) + " triangles a frame of " +
           base::with_thousands(ours->vertices) + " vertices takes " + base::milliseconds(ours->cpu_ms) +
           ", " + few_digits(plain->cpu_ms / ours->cpu_ms) +
           " times less than the plain one. While one vertex is dragged it takes " +
           base::milliseconds(dragged->cpu_ms) + ".";
  return seen;
}

}  // namespace

Section accuracy_section(const Figures& figures) {
  const auto worst = [&](Method m) {
    return error_text(worst_of_clusters(figures.accuracy, std::string(sym3::label(m))));
  };
  const std::string count = "viete bench accuracy --count " + std::to_string(figures.sizes.samples);
  return {"errors",
          "Ours",
          "How exact",
          "Where eigenvalues come close, SD is off by up to " + worst(Method::sd) + " and Improved SD by " +
              worst(Method::improved_sd) + ", in double; Diag by " + worst(Method::diag) + " and Fast by " +
              worst(Method::fast) + ", at any gap.",
          "SD and Improved SD divide by differences of eigenvalues. As these shrink, digits go, until below "
          "a gap of "
          "1e-6 two count as equal, which leaves an error of the size of the gap. Diag and Fast divide by "
          "none. With "
          "the spread the error of all grows: exp itself does.",
          error_plots(figures) + error_tables("double", figures.accuracy) +
              error_tables("float", figures.accuracy_in_float) +
              paragraph("The largest of " + base::with_thousands(figures.sizes.samples) +
                            " matrices each, in the Frobenius norm, against 106 bits.",
                        "note"),
          {count, count + " --float"}};
}

Section frames_section(const Figures& figures) {
  const struct {
    const char *name, *label, *color;
  } paths[] = {{frame_names::reference, "plain", plot_color::reference},
               {frame_names::dense, "dense", plot_color::ours[2]},
               {frame_names::compressed, "compressed", plot_color::ours[0]},
               {frame_names::dragged, "dragged", plot_color::ours[1]}};
  Plot plot;
  plot.across = "triangles of the cage";
  HtmlTable table{{"cage triangles"}, {}};
  for (const auto& path : paths) {
    PlotCurve curve{path.label, path.color, false, {}};
    for (const std::size_t faces : figures.sizes.faces) {
      if (const FrameTime* t = frame_of(figures.frames, path.name, faces))
        curve.points.push_back({static_cast<double>(faces), t->cpu_ms});
    }
    if (curve.points.empty()) continue;
    plot.curves.push_back(std::move(curve));
    table.columns.push_back(std::string(path.label) + ", ms");
  }
  table.columns.insert(table.columns.end(), {"error, dense", "error, compressed"});
  for (const std::size_t faces : figures.sizes.faces) {
    table.rows.push_back({std::to_string(faces)});
    for (const auto& path : paths)
      if (const FrameTime* t = frame_of(figures.frames, path.name, faces))
        table.rows.back().push_back(few_digits(t->cpu_ms));
    for (const char* name : {frame_names::dense, frame_names::compressed}) {
      const FrameTime* t = frame_of(figures.frames, name, faces);
      table.rows.back().push_back(t && !std::isnan(t->error) ? error_text(t->error) : "");
    }
  }
  std::string sizes;
  for (const std::size_t faces : figures.sizes.faces)
    sizes += (sizes.empty() ? "" : ",") + std::to_string(faces);
  const std::string command = "viete bench frame " + shell_word(figures.files.model) + " --faces " + sizes +
                              " --rounds " + std::to_string(figures.sizes.rounds);
  return {"frames",
          "Ours",
          "Frames by cage",
          frames_seen(figures),
          "Plain is a rebuild of published tools: matrices blended in double, one vertex after the other. "
          "Dense blends "
          "all weights in one pass in float. Compressed blends a few vertices of each leaf exactly and "
          "interpolates "
          "the logarithms of the others. Dragged adds only what moves to sums that were formed at the first "
          "frame.",
          "<div class=\"plots\">" + figure("ms a frame with normals, one thread", draw_curves(plot)) +
              "</div>\n" + html(table) +
              paragraph("Processor time of one thread; cages are made around the model. Errors are against "
                        "double, in diagonals of the "
                        "cage.",
                        "note"),
          {command}};
}

namespace {

using base::few_digits, sym3::Method;

std::string count_option(std::size_t count) {
  return " --count " + std::to_string(count);
}

double ns_of(const ExpBench& bench, Method method) {
  return time_of(bench.methods, std::string(sym3::name(method)));
}

// Ratios to the first row and to the copy.
HtmlTable times_table(const std::vector<PlotBar>& bars, double copy, const std::string& unit) {
  HtmlTable table{{"", unit, "times faster than " + bars.front().name}, {}};
  if (copy > 0) table.columns.emplace_back("times the copy");
  for (const PlotBar& bar : bars) {
    table.rows.push_back({bar.name, few_digits(bar.ns), few_digits(bars.front().ns / bar.ns)});
    if (copy > 0) table.rows.back().push_back(few_digits(bar.ns / copy));
  }
  return table;
}

std::string method_table() {
  HtmlTable table{{"method", "what it does"}, {}, {"what it does"}};
  for (const sym3::MethodEntry& m : sym3::methods()) {
    if (m.method != Method::improved_sd_faithful) table.rows.push_back({m.label, m.sentence});
  }
  return html(table);
}

std::string layouts_table(const ExpBench& bench) {
  HtmlTable table{{"layout", "matrices", "Fast, ns", "copy, ns", "Diag, ns", "Improved SD, ns"}, {}};
  for (const LayoutResult& r : bench.layouts)
    table.rows.push_back({layout_name(r.layout), base::with_thousands(r.count), few_digits(r.fast),
                          few_digits(r.copy), few_digits(r.diag), few_digits(r.improved_sd)});
  return html(table);
}

std::string plots_of(const ExpBench& bench, const std::string& precision) {
  const Plot plot = plot_of(bench);
  return "<h3>In " + precision + "</h3>\n<div class=\"plots\">" +
         figure("ns a matrix, " + base::with_thousands(bench.count) + " from memory", draw_bars(plot)) +
         figure("ns a matrix, by size of the batch and layout", draw_curves(plot)) + "</div>\n" +
         html(times_table(plot.bars, time_of(bench.methods, "copy"), "ns a matrix")) +
         "<details><summary>By layout and size, in " + precision + "</summary>" + layouts_table(bench) +
         "</details>\n";
}

}  // namespace

Section eigenvalues_section(const Figures& figures) {
  const EigenBench& bench = figures.eigen;
  const auto ns = [&](const char* name) { return time_of(bench.results, name); };
  const Plot plot = plot_of(bench);
  return {
      "eigenvalues",
      "Figure 1 of the paper",
      "Eigenvalues",
      "Viete\u2019s formula takes " + percent(percent_less(ns("Viete"), ns("QR"))) +
          " less time than QR, ours " + percent(percent_less(ns("Fast"), ns("QR"))) + " less.",
      "QR rotates the matrix again and again until it is diagonal. The formula solves the characteristic "
      "polynomial with one arc cosine and three cosines, without a loop. Direct is Eigen\u2019s closed form.",
      "<div class=\"plots\">" +
          figure("ns a matrix, " + base::with_thousands(bench.count) + " matrices, double", draw_bars(plot)) +
          "</div>\n" + html(times_table(plot.bars, ns("copy"), "ns a matrix")),
      {"viete bench eigen" + count_option(bench.count)}};
}

Section exponentials_section(const Figures& figures) {
  const ExpBench& bench = figures.exp;
  const double diag = ns_of(bench, Method::diag), sd = percent_less(ns_of(bench, Method::sd), diag),
               improved = percent_less(ns_of(bench, Method::improved_sd), diag);
  const std::string saved = std::abs(sd) < 4 ? "next to nothing" : percent(sd);
  return {
      "exponentials",
      "Figure 2 of the paper",
      "Exponentials",
      "Against Diag, SD saves " + saved + ", Improved SD " + percent(improved) + ", and Fast is " +
          few_digits(diag / ns_of(bench, Method::fast)) + " times faster: " +
          few_digits(ns_of(bench, Method::fast)) + " ns a matrix, where a copy of the same bytes takes " +
          few_digits(time_of(bench.methods, "copy")) + " ns.",
      "Diag needs eigenvalues and eigenvectors. SD does without the vectors, but its eigenvalues are still "
      "by "
      "QR, which is what costs. Improved SD takes them by the formula. Fast needs no eigenvalues at all: it "
      "sums the series by a recurrence in two invariants, without branch, division or cosine, many matrices "
      "at once.",
      method_table() + plots_of(bench, "double") + plots_of(figures.exp_in_float, "float"),
      {"viete bench exp" + count_option(bench.count),
       "viete bench exp" + count_option(figures.exp_in_float.count) + " --float"}};
}

Section deformation_section(const Figures& figures) {
  Plot plot;
  plot.unit = " ms";
  HtmlTable table{{"method", "frame, ms", "exponentials, ms", "their share", "blend, ms", "rest, ms"}, {}};
  for (const Method m : {Method::diag, Method::sd, Method::improved_sd, Method::fast}) {
    const FrameTime* t = staged_frame(figures.deformation, m);
    if (!t) continue;
    const std::string label(sym3::label(m));
    const double exp = t->links[deform::Link::exp], blend = t->links[deform::Link::blend];
    plot.bars.push_back({label, t->cpu_ms, color_of_method(label), exp});
    table.rows.push_back({label, few_digits(t->cpu_ms), few_digits(exp),
                          percent(100 * exp / t->links.total()), few_digits(blend),
                          few_digits(t->links.total() - exp - blend)});
  }
  Section section{"deformation", "Figure 3 of the paper", "Deformation", "", "", "", {}};
  section.commands = {"viete bench frame " + shell_word(figures.files.model) + " " +
                      shell_word(figures.files.cage) + " --rounds " + std::to_string(figures.sizes.rounds)};
  if (plot.bars.size() < 4) {
    section.seen = "There is not enough memory for frames link by link, in double.";
    return section;
  }
  const FrameTime& first = figures.deformation.front();
  section.seen = "Of a whole frame the exponentials are " + table.rows[0][3] + " with Diag, " +
                 table.rows[2][3] + " with Improved SD and " + table.rows[3][3] +
                 " with Fast, which makes the frame " + few_digits(plot.bars[0].ns / plot.bars[3].ns) +
                 " times faster.";
  section.why =
      "Every vertex takes one exponential a frame. What remains when that is cheap is the weighted sum of "
      "the cage\u2019s logarithms (blend), which grows with the cage. The program itself runs all of it in "
      "one "
      "pass, see below.";
  section.body = "<div class=\"plots\">" +
                 figure("ms a frame, " + base::with_thousands(first.vertices) + " vertices, cage of " +
                            std::to_string(first.faces) + " triangles; in colour: exponentials",
                        draw_bars(plot)) +
                 "</div>\n" + html(table);
  return section;
}

Section paper_section(const Figures& figures) {
  const auto ns = [&](const char* name) { return time_of(figures.eigen.results, name); };
  HtmlTable table{{"less time", "in the paper", "here"}, {}};
  table.rows = {
      {"Eigenvalues: formula against QR", "69 %", percent(percent_less(ns("Viete"), ns("QR")))},
      {"Exponentials: Improved SD against Diag", "76 %",
       percent(percent_less(ns_of(figures.exp, Method::improved_sd), ns_of(figures.exp, Method::diag)))}};
  const FrameTime *diag = staged_frame(figures.deformation, Method::diag),
                  *improved = staged_frame(figures.deformation, Method::improved_sd);
  if (diag && improved)
    table.rows.push_back({"Deformation: Improved SD against Diag", "19 %",
                          percent(percent_less(improved->cpu_ms, diag->cpu_ms))});
  return {
      "paper",
      "All three figures",
      "Beside the paper",
      "What the paper claims holds here, too: the formula makes eigenvalues, and with them exponentials, "
      "several "
      "times cheaper.",
      "S. Kaji and H. Ochiai, A Fast Computation of 3x3 Matrix Exponentials and its Application in CG.",
      html(table) +
          paragraph(
              "What differs: machine, compiler and year. The paper times a dragon of 50,000 vertices and "
              "100,000 triangles. It does not say in which precision, and its cosine is a routine of "
              "single precision. Its processor, its compiler, its absolute times and the size of its cage "
              "are not known to this program, so that only savings stand side by side. The share of the "
              "exponentials in a frame, and with it the last row, depends on the cage. Formulas are as "
              "printed but for misprints.",
              "note"),
      {}};
}

}  // namespace viete::bench
