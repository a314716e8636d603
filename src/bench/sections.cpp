#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/text.h"
#include "bench/page.h"

namespace viete::bench {

namespace {

using base::few_digits;
using sym3::Method;

constexpr Method shown_methods[] = {Method::diag, Method::sd, Method::improved_sd, Method::fast};

// Number of cage triangles in the texts about frame times.
constexpr std::size_t usual_faces = 300;

// Returns the time saved in percent. Example: if `time` is 0.24 and `than` is 1, returns 76.
double percent_less(double time, double than) {
  return 100 * (1 - time / than);
}

const FrameTime* staged_frame(std::span<const FrameTime> times, sym3::Method method) {
  return times.empty() ? nullptr
                       : frame_of(times, "staged, " + std::string(sym3::name(method)), times.front().faces);
}

double error_of(const AccuracyTable::Row& row, Method method) {
  const auto methods = exp_methods();
  const auto at = std::ranges::find(methods, sym3::label(method),
                                    [](const ExpMethod& m) { return std::string_view(m.name); });
  return row.cells[static_cast<std::size_t>(at - methods.begin())].worst;
}

// Returns the largest error of the method in double precision, over all tables whose rows are gaps.
std::string worst_error(const Figures& figures, Method method) {
  double worst = 0;
  for (const AccuracyTable& table : figures.accuracy)
    if (table.by == "gap")
      for (const auto& row : table.rows) worst = std::max(worst, error_of(row, method));
  return error_text(worst);
}

std::string lost_volume(const nlohmann::json& halfway) {
  const double lost = 100 * (1 - double(halfway["volume"]));
  return lost < 0.5 ? "nothing" : percent(lost);
}

std::string plots(const std::string& figures) {
  return "<div class=\"plots\">" + figures + "</div>\n";
}

std::string details(const std::string& title, const std::string& body) {
  return "<details><summary>" + title + "</summary>\n" + body + "</details>\n";
}

std::string count_option(std::size_t count) {
  return " --count " + std::to_string(count);
}

Section eigenvalues_section(const Figures& figures) {
  const EigenBench& bench = figures.eigen;
  const auto ns = [&](const char* name) { return time_of(bench.results, name); };
  return {"eigenvalues",
          "Figure 1 of the paper",
          "Eigenvalues",
          "Viete\u2019s formula takes " + percent(percent_less(ns("Viete"), ns("QR"))) +
              " less time than QR; Fast takes " + percent(percent_less(ns("Fast"), ns("QR"))) + " less.",
          "QR rotates the matrix repeatedly until it is diagonal. The formula solves the characteristic "
          "polynomial with one arc cosine and three cosines, without iteration. Direct is the closed form "
          "of Eigen. Fast computes eigenvectors, too: " +
              percent(percent_less(ns("Fast, vectors"), ns("QR, vectors"))) + " less time than QR.",
          plots(figure("ns per matrix, " + base::with_thousands(bench.count) + " matrices, double",
                       draw_bars(plot_of(bench)))) +
              html(times_table(bench.results, "ns per matrix")),
          {"viete bench eigen" + count_option(bench.count)}};
}

double ns_of(const ExpBench& bench, Method method) {
  return time_of(bench.methods, std::string(sym3::name(method)));
}

std::string method_table() {
  Table table{{"method", "what it does"}, {}, {"what it does"}};
  for (const sym3::MethodEntry& m : sym3::methods()) table.rows.push_back({m.label, m.sentence});
  return html(table);
}

std::string exponentials(const ExpBench& bench, const std::string& precision) {
  const Plot plot = plot_of(bench);
  return "<h3>In " + precision + " precision</h3>\n" +
         plots(
             figure("ns per matrix, " + base::with_thousands(bench.count) + " from memory", draw_bars(plot)) +
             figure("ns per matrix, by batch size and layout", draw_curves(plot))) +
         html(times_table(labelled_times(bench), "ns per matrix")) +
         details("By layout and size, in " + precision + " precision", html(layouts_table(bench)));
}

Section exponentials_section(const Figures& figures) {
  const ExpBench& bench = figures.exp;
  const double diag = ns_of(bench, Method::diag), fast = ns_of(bench, Method::fast),
               sd = percent_less(ns_of(bench, Method::sd), diag),
               improved = percent_less(ns_of(bench, Method::improved_sd), diag);
  return {"exponentials",
          "Figure 2 of the paper",
          "Exponentials",
          "Compared with Diag, SD saves " + (std::abs(sd) < 4 ? "next to nothing" : percent(sd)) +
              ", Improved SD saves " + percent(improved) + ", and Fast is " + few_digits(diag / fast) +
              " times faster: " + few_digits(fast) + " ns per matrix. Copying the same bytes takes " +
              few_digits(time_of(bench.methods, "copy")) + " ns.",
          "Diag computes eigenvalues and eigenvectors. SD needs no eigenvectors, but computes the "
          "eigenvalues by QR, which takes most of the time. Improved SD uses the formula instead. Fast needs "
          "no eigenvalues: it evaluates the series by a recurrence in two invariants, without branches, "
          "divisions or cosines, for many matrices at once.",
          method_table() + exponentials(bench, "double") + exponentials(figures.exp_in_float, "single"),
          {"viete bench exp" + count_option(bench.count),
           "viete bench exp" + count_option(figures.exp_in_float.count) + " --float"}};
}

Section deformation_section(const Figures& figures) {
  Plot plot;
  plot.unit = " ms";
  Table table{{"method", "frame, ms", "exponentials, ms", "part of frame", "blend, ms", "rest, ms"}, {}};
  for (const Method m : shown_methods) {
    const FrameTime* t = staged_frame(figures.deformation, m);
    if (!t) continue;
    const std::string label(sym3::label(m));
    const double exp = t->stages[pose::Stage::exp], blend = t->stages[pose::Stage::blend];
    plot.bars.push_back({label, t->cpu_ms, color_of_method(label), exp});
    table.rows.push_back({label, few_digits(t->cpu_ms), few_digits(exp),
                          percent(100 * exp / t->stages.total()), few_digits(blend),
                          few_digits(t->stages.total() - exp - blend)});
  }
  Section section{"deformation", "Figure 3 of the paper", "Deformation", "", "", "", {}};
  section.commands = {"viete bench frame " + shell_word(figures.files.model) + " " +
                      shell_word(figures.files.cage) + " --rounds " + std::to_string(figures.sizes.rounds)};
  if (plot.bars.size() < 4) {
    section.seen = "There is not enough memory to measure frames stage by stage in double precision.";
    return section;
  }
  const FrameTime& first = figures.deformation.front();
  section.seen = "The exponentials take " + table.rows[0][3] + " of a frame with Diag, " + table.rows[2][3] +
                 " with Improved SD and " + table.rows[3][3] + " with Fast, which makes the frame " +
                 few_digits(plot.bars[0].ns / plot.bars[3].ns) + " times faster.";
  section.why =
      "Each vertex needs one exponential per frame. If it is cheap, the weighted sum of the cage\u2019s "
      "logarithms (blend) takes most of the time and grows with the cage. The viewer computes everything in "
      "one pass; see Frames by cage.";
  section.body =
      plots(figure("ms per frame, " + base::with_thousands(first.vertices) + " vertices, cage of " +
                       std::to_string(first.faces) + " triangles; coloured: exponentials",
                   draw_bars(plot))) +
      html(table);
  return section;
}

Section paper_section(const Figures& figures) {
  const auto ns = [&](const char* name) { return time_of(figures.eigen.results, name); };
  Table table{{"time saved", "in the paper", "here"}, {}};
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
      "Comparison with the paper",
      "The claims of the paper hold here too: the formula makes eigenvalues, and therefore exponentials, "
      "several times cheaper.",
      "S. Kaji and H. Ochiai, A Fast Computation of 3x3 Matrix Exponentials and its Application in CG.",
      html(table) +
          paragraph("The paper measures a dragon of 50,000 vertices and 100,000 triangles. It does not state "
                    "the precision, but its cosine is a single-precision routine. Its processor, compiler, "
                    "absolute times and cage size are unknown, so only the savings are compared. The last "
                    "row depends on the cage. The formulas are as printed, with misprints corrected.",
                    "note"),
      {}};
}

// Draws the errors of the four methods. Skips very small scales, where rounding makes all matrices zero.
std::string errors_plot(const AccuracyTable& accuracy) {
  constexpr double least = 1e-20;
  Plot plot;
  plot.across = accuracy.by;
  for (const Method m : shown_methods) {
    const std::string label(sym3::label(m));
    PlotCurve curve{label, color_of_method(label), false, {}};
    for (const auto& row : accuracy.rows)
      if (row.value >= least) curve.points.push_back({row.value, error_of(row, m)});
    std::ranges::sort(curve.points, {}, &PlotCurve::Point::count);
    plot.curves.push_back(std::move(curve));
  }
  return draw_curves(plot);
}

std::string error_plots(const Figures& figures) {
  constexpr const char* titles[] = {"Two close eigenvalues", "Three close eigenvalues",
                                    "By spread: largest minus smallest eigenvalue",
                                    "By scale of the entries"};
  std::string text;
  for (std::size_t i = 0; i < std::size(titles); ++i)
    text += "<h3>" + std::string(titles[i]) + "</h3>\n" +
            plots(figure("largest relative error, double", errors_plot(figures.accuracy[i + 1])) +
                  figure("largest relative error, float", errors_plot(figures.accuracy_in_float[i + 1])));
  return text;
}

std::string error_tables(const std::string& precision, const std::vector<AccuracyTable>& tables) {
  std::string text;
  for (const AccuracyTable& table : tables)
    text += paragraph(table.title, "note") + html(errors_table(table));
  return details("All errors, in " + precision, text);
}

Section accuracy_section(const Figures& figures) {
  const auto worst = [&](Method m) { return worst_error(figures, m); };
  const std::string count = "viete bench accuracy" + count_option(figures.sizes.samples);
  return {
      "errors",
      "Not in the paper",
      "Accuracy",
      "Where eigenvalues are close, the largest relative error is " + worst(Method::sd) + " with SD and " +
          worst(Method::improved_sd) + " with Improved SD, in double precision. Diag stays at " +
          worst(Method::diag) + " and Fast at " + worst(Method::fast) + " at any gap.",
      "SD and Improved SD divide by differences of eigenvalues. Small differences lose digits; below 1e-6 "
      "two eigenvalues count as equal, which leaves an error of about the gap. Diag and Fast do not divide "
      "by differences. All errors grow with the spread, because exp itself becomes more sensitive.",
      error_plots(figures) + error_tables("double", figures.accuracy) +
          error_tables("float", figures.accuracy_in_float) +
          paragraph("The largest error of " + base::with_thousands(figures.sizes.samples) +
                        " matrices per row, in the Frobenius norm, compared with 106-bit results.",
                    "note"),
      {count, count + " --float"}};
}

std::string frames_seen(const Figures& figures) {
  const FrameTime* plain = frame_of(figures.frames, frame_names::reference, usual_faces);
  const FrameTime* ours = frame_of(figures.frames, frame_names::compressed, usual_faces);
  const FrameTime* dragged = frame_of(figures.frames, frame_names::dragged, usual_faces);
  if (!ours) ours = frame_of(figures.frames, frame_names::dense, usual_faces);
  if (!plain || !ours || !dragged) return "There is not enough memory for the published deformer.";
  return "In a cage of " + std::to_string(usual_faces) + " triangles, a frame of " +
         base::with_thousands(ours->vertices) + " vertices takes " + base::milliseconds(ours->cpu_ms) + ", " +
         few_digits(plain->cpu_ms / ours->cpu_ms) +
         " times less than with the published deformer. While one vertex is dragged, it takes " +
         base::milliseconds(dragged->cpu_ms) + ".";
}

Section frames_section(const Figures& figures) {
  const struct {
    const char *name, *label, *color;
  } paths[] = {{frame_names::reference, "published", plot_color::reference},
               {frame_names::dense, "dense", plot_color::ours[2]},
               {frame_names::compressed, "compressed", plot_color::ours[0]},
               {frame_names::dragged, "dragged", plot_color::ours[1]}};
  Plot plot;
  plot.across = "triangles of the cage";
  Table table{{"cage triangles"}, {}};
  std::string sizes;
  for (const std::size_t faces : figures.sizes.faces) {
    table.rows.push_back({std::to_string(faces)});
    sizes += (sizes.empty() ? "" : ",") + std::to_string(faces);
  }
  for (const auto& path : paths) {
    PlotCurve curve{path.label, path.color, false, {}};
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      if (const FrameTime* t = frame_of(figures.frames, path.name, figures.sizes.faces[i])) {
        curve.points.push_back({static_cast<double>(t->faces), t->cpu_ms});
        table.rows[i].push_back(few_digits(t->cpu_ms));
      }
    if (curve.points.empty()) continue;
    plot.curves.push_back(std::move(curve));
    table.columns.push_back(std::string(path.label) + ", ms");
  }
  table.columns.insert(table.columns.end(), {"error, dense", "error, compressed"});
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (const char* name : {frame_names::dense, frame_names::compressed}) {
      const FrameTime* t = frame_of(figures.frames, name, figures.sizes.faces[i]);
      table.rows[i].push_back(t && !std::isnan(t->error) ? error_text(t->error) : "");
    }
  return {"frames",
          "Not in the paper",
          "Frames by cage",
          frames_seen(figures),
          "Published: blends matrices vertex by vertex in double precision, as published tools do. Dense: "
          "blends all weights in one pass in single precision. Compressed: blends a few vertices of each "
          "block exactly and interpolates the logarithms of the others. Dragged: adds only the change to "
          "the sums from the start of the drag.",
          plots(figure("ms per frame with normals, one thread", draw_curves(plot))) + html(table) +
              paragraph("Processor time of one thread. The cages are generated around the model. Errors are "
                        "relative to double precision, in diagonals of the cage.",
                        "note"),
          {"viete bench frame " + shell_word(figures.files.model) + " --faces " + sizes + " --rounds " +
           std::to_string(figures.sizes.rounds)}};
}

std::string label_of(const Mode& mode) {
  const auto preset = pose::preset_of(mode.deformer);
  return preset ? std::string(base::entry_of(*preset).label) : pose::text(mode.deformer);
}

std::string number(double value) {
  return std::isfinite(value) ? few_digits(value) : std::isnan(value) ? "" : "collapsed";
}

double energy(const Mode& mode) {
  return over_poses(mode, &ShapeQuality::energy_ratio).middle;
}
double bending(const Mode& mode) {
  return over_poses(mode, &ShapeQuality::bending_ratio).middle;
}
double frame(const Mode& mode) {
  return mode.frame_ms;
}

using Modes = std::vector<const Mode*>;

const Mode& least(const Modes& modes, double (*value)(const Mode&)) {
  return **std::ranges::min_element(
      modes, {}, [&](const Mode* m) { return std::isnan(value(*m)) ? HUGE_VAL : value(*m); });
}

bool is_default(const Mode& mode) {
  return pose::preset_of(mode.deformer) == pose::Preset::smooth;
}

std::string deformers_plot(const char* title, const Modes& modes, double (*value)(const Mode&),
                           const char* unit) {
  Plot plot;
  plot.unit = unit;
  plot.compared = false;
  for (const Mode* m : modes)
    if (std::isfinite(value(*m)))
      plot.bars.push_back({label_of(*m), value(*m), is_default(*m) ? plot_color::ours[0] : plot_color::copy});
  return plot.bars.empty() ? "" : figure(title, draw_bars(plot));
}

Table deformers_table(const Modes& modes) {
  Table table{
      {"deformer", "energy", "at worst", "bending", "volume", "gap", "torn", "frame, ms", "binding, ms"}, {}};
  for (const Mode* m : modes) {
    const auto energies = over_poses(*m, &ShapeQuality::energy_ratio),
               volumes = over_poses(*m, &ShapeQuality::volume);
    table.rows.push_back(
        {label_of(*m), number(energies.middle), number(energies.most), number(bending(*m)),
         std::isnan(volumes.least) ? "" : percent(100 * volumes.least) + " to " + percent(100 * volumes.most),
         few_digits(100 * over_poses(*m, &ShapeQuality::gap).middle),
         few_digits(100 * over_poses(*m, &ShapeQuality::torn).most), few_digits(m->frame_ms),
         std::to_string(std::lround(m->bind_ms))});
  }
  return table;
}

std::string descriptions(const Modes& modes) {
  Table table{{"deformer", "what it does"}, {}, {"what it does"}};
  for (const Mode* m : modes)
    if (const auto preset = pose::preset_of(m->deformer))
      table.rows.push_back({label_of(*m), std::string(base::entry_of(*preset).hint)});
  return details("Description of the deformers", html(table));
}

std::string deformers_seen(const Modes& modes, std::size_t poses) {
  const auto distorts = [](const Mode& mode, const std::string& how = "") {
    return number(energy(mode)) + " times as much as mean value coordinates" + how + ", at " +
           base::milliseconds(frame(mode)) + " per frame. ";
  };
  const Mode &undistorted = least(modes, energy), &unbent = least(modes, bending),
             &fast = least(modes, frame);
  std::string text =
      label_of(undistorted) + " distorts least: " +
      distorts(undistorted, poses > 1 ? " (median of " + std::to_string(poses) + " poses)" : "");
  text += (&undistorted == &unbent ? "It also" : label_of(unbent)) + " bends least. ";
  for (const Mode* m : modes)
    if (m != &undistorted && is_default(*m)) text += "Smooth, the default, distorts " + distorts(*m);
  return text + "The fastest is " + label_of(fast) + ", at " + base::milliseconds(frame(fast)) +
         " per frame.";
}

Section deformers_section(const Figures& figures) {
  Modes modes;
  std::string problems, poses;
  for (const Mode& mode : figures.deformers.modes) {
    if (mode.problem.empty())
      modes.push_back(&mode);
    else
      problems += paragraph(label_of(mode) + ": " + mode.problem, "note");
  }
  Section section{"deformers", "Not in the paper", "Deformers", "", "", "", {}};
  section.commands = {"viete bench modes " + shell_word(figures.files.model) + " " +
                      shell_word(figures.files.cage)};
  for (const auto& pose : figures.files.poses) section.commands[0] += " " + shell_word(pose);
  for (const NamedPose& pose : figures.poses) poses += (poses.empty() ? "" : ", ") + pose.name;
  section.body = problems;
  if (modes.empty()) return section;
  section.seen = deformers_seen(modes, figures.poses.size());
  section.why =
      "A deformer is a choice of weights and blend. Low energy is not the only criterion: Mean "
      "value reproduces affine poses exactly, Local keeps distant parts at rest, and As published needs "
      "neither a surface nor a solver.";
  section.body =
      plots(deformers_plot("energy, relative to mean value coordinates", modes, energy, "") +
            deformers_plot("ms per frame, one thread", modes, frame, " ms")) +
      html(deformers_table(modes)) + problems +
      paragraph(
          "Poses: " + poses +
              ". Energy: symmetric Dirichlet energy of the triangles. Bending: energy of the changes of "
              "angle between triangles (discrete shells). Both are medians relative to mean value "
              "coordinates. Volume: relative to rest. Gap: mean distance of the surface from the motion "
              "of the nearby cage. Torn: largest change of distance between vertices that are close at rest "
              "but not joined by edges. Gap and torn are in % of the diagonal.",
          "note") +
      descriptions(modes);
  return section;
}

constexpr std::tuple<const char*, const char*, const char*> interpolations[] = {
    {"linear", "linear", plot_color::rival}, {"log space", "log_space", plot_color::ours[0]}};

Plot volumes_of(const nlohmann::json& row) {
  Plot plot;
  plot.linear = true;
  plot.across = "0: rest, 1: shape";
  for (const auto& [name, key, color] : interpolations) {
    PlotCurve curve{name, color, false, {}};
    const auto& volumes = row[key]["volumes"];
    for (std::size_t i = 0; i < volumes.size(); ++i)
      curve.points.push_back(
          {static_cast<double>(i) / static_cast<double>(volumes.size() - 1), double(volumes[i])});
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

Section shapes_section(const Figures& figures) {
  Section section{"shapes", "Not in the paper", "Between shapes", "", "", "", {}};
  Table table{{"halfway to", "volume, log space", "volume, linear", "edges, log space", "edges, linear"}, {}};
  Plot edges;
  edges.unit = " %";
  edges.compared = false;
  std::string curves;
  for (const auto& row : figures.shapes.rows) {
    const std::string name = name_of_shape(row);
    curves += figure("volume between rest and " + name, draw_curves(volumes_of(row)));
    for (const auto& [how, key, color] : interpolations)
      edges.bars.push_back({name + ", " + how, 100 * double(row[key]["edges"]), color});
    table.rows.push_back({name});
    for (const char* what : {"volume", "edges"})
      for (const char* key : {"log_space", "linear"})
        table.rows.back().push_back(percent(100 * double(row[key][what])));
  }
  section.body =
      plots(curves + figure("deviation of edge lengths halfway, %", draw_bars(edges))) + html(table) +
      paragraph(
          "Volume: relative to the smaller of both shapes. Edges: root mean square deviation of the "
          "logarithms of lengths from the mean of both shapes. Shapes of the bundled dragon.",
          "note");
  const auto& most = figures.shapes.rows[figures.shapes.most_lost];
  const auto &linear = most["linear"], &logs = most["log_space"];
  section.seen = "Halfway to " + name_of_shape(most) + ", linear interpolation loses " + lost_volume(linear) +
                 " of the volume, and edge lengths deviate by " + percent(100 * double(linear["edges"])) +
                 ". Log space loses " + lost_volume(logs) + ", and edge lengths deviate by " +
                 percent(100 * double(logs["edges"])) + ".";
  section.why =
      "Linear interpolation moves each point along a straight line. If a part rotates by 180\u00b0, its "
      "points meet at the axis and the part collapses. Logarithms interpolate the rotation itself, so each "
      "triangle turns about the axis and keeps its size.";
  return section;
}

std::string tile(const std::string& value, const std::string& what) {
  return "<div><dt>" + escaped(what) + "</dt><dd>" + escaped(value) + "</dd></div>\n";
}

}  // namespace

std::string summary_of(const Figures& figures) {
  const auto& most = figures.shapes.rows[figures.shapes.most_lost];
  std::string tiles =
      tile(few_digits(ns_of(figures.exp, Method::diag) / ns_of(figures.exp, Method::fast)) + "\u00d7",
           "exponentials by Fast compared with Diag, double precision, from memory") +
      tile(worst_error(figures, Method::fast),
           "largest relative error of Fast where eigenvalues are close; Improved SD: " +
               worst_error(figures, Method::improved_sd));
  const FrameTime* plain = frame_of(figures.frames, frame_names::reference, usual_faces);
  const FrameTime* ours = frame_of(figures.frames, frame_names::compressed, usual_faces);
  if (plain && ours)
    tiles += tile(base::milliseconds(ours->cpu_ms),
                  "a frame of " + base::with_thousands(ours->vertices) + " vertices in a cage of " +
                      std::to_string(usual_faces) +
                      " triangles; published deformer: " + base::milliseconds(plain->cpu_ms));
  tiles += tile(lost_volume(most["linear"]),
                "of the volume is lost halfway to " + name_of_shape(most) +
                    " by linear interpolation; in log space: " + lost_volume(most["log_space"]));
  return "<dl class=\"tiles\">\n" + tiles + "</dl>\n";
}

std::vector<Section> sections_of(const Figures& figures) {
  return {eigenvalues_section(figures), exponentials_section(figures), deformation_section(figures),
          paper_section(figures),       accuracy_section(figures),     frames_section(figures),
          deformers_section(figures),   shapes_section(figures)};
}

}  // namespace viete::bench
