#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "bench/findings.h"
#include "bench/html.h"
#include "bench/methods.h"
#include "bench/modes_table.h"
#include "bench/plot.h"
#include "bench/sections.h"
#include "bench/svg.h"

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

// Of the four methods; scales so small that all matrices are zero by rounding are left out.
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

}  // namespace viete::bench
