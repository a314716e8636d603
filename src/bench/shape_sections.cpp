#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/text.h"
#include "bench/figures.h"
#include "bench/halfway.h"
#include "bench/html.h"
#include "bench/modes_table.h"
#include "bench/plot.h"
#include "bench/sections.h"

namespace viete::bench {

namespace {

using base::few_digits;

constexpr const char* smooth_color = plot_color::ours[0];

std::string label_of(const Mode& mode) {
  const auto way = deform::way_of(mode.scheme);
  return way ? std::string(deform::entry(*way).label) : deform::text(mode.scheme);
}

std::string number(double value) {
  return std::isfinite(value) ? few_digits(value) : std::isnan(value) ? "" : "collapsed";
}

std::string percent_of_diagonal(double share) {
  return few_digits(100 * share);
}

double energy(const Mode& mode) {
  return over_poses(mode, [](const auto& q) { return q.energy_ratio; }).middle;
}
double bending(const Mode& mode) {
  return over_poses(mode, [](const auto& q) { return q.bending_ratio; }).middle;
}
double frame(const Mode& mode) {
  return mode.frame_ms;
}

using Modes = std::vector<const Mode*>;

const Mode& least(const Modes& modes, double (*value)(const Mode&)) {
  return **std::ranges::min_element(modes, {}, [&](const Mode* m) {
    return std::isnan(value(*m)) ? std::numeric_limits<double>::infinity() : value(*m);
  });
}

std::string ways_plot(const char* title, const Modes& modes, double (*value)(const Mode&), const char* unit) {
  Plot plot;
  plot.unit = unit, plot.compared = false;
  for (const Mode* m : modes) {
    const bool usual = deform::way_of(m->scheme) == deform::Way::smooth;
    if (std::isfinite(value(*m)))
      plot.bars.push_back({label_of(*m), value(*m), usual ? smooth_color : plot_color::copy});
  }
  return plot.bars.empty() ? "" : figure(title, draw_bars(plot));
}

HtmlTable ways_table(const Modes& modes) {
  HtmlTable table{
      {"way", "energy", "at worst", "bending", "volume", "gap", "torn", "frame, ms", "binding, ms"}, {}};
  for (const Mode* m : modes) {
    const auto energies = over_poses(*m, [](const auto&q) { return q.energy_ratio; }),
               volumes = over_poses(*m, [](const auto&q) { return q.volume; });
    const double gap = over_poses(*m, [](const auto&q) { return q.gap; }).middle,
                 torn = over_poses(*m, [](const auto&q) { return q.torn; }).most;
    table.rows.push_back(
        {label_of(*m), number(energies.middle), number(energies.most), number(bending(*m)),
         std::isnan(volumes.least) ? "" : percent(100 * volumes.least) + " to " + percent(100 * volumes.most),
         percent_of_diagonal(gap), percent_of_diagonal(torn), few_digits(m->frame_ms),
         std::to_string(std::lround(m->bind_ms))});
  }
  return table;
}

HtmlTable meaning_of_ways(const Modes& modes) {
  HtmlTable table{{"way", "what it does"}, {}, {"what it does"}};
  for (const Mode* m : modes)
    if (const auto way = deform::way_of(m->scheme))
      table.rows.push_back({label_of(*m), std::string(deform::entry(*way).sentence)});
  return table;
}

std::string frame_text(const Mode& mode) {
  return base::milliseconds(mode.frame_ms) + " a frame";
}

std::string seen_of(const Modes& modes, std::size_t poses) {
  const Mode &undistorted = least(modes, energy), &unbent = least(modes, bending),
             &fast = least(modes, frame);
  std::string text = label_of(undistorted) + " distorts least: " + number(energy(undistorted)) +
                     " times as much as mean value coordinates" +
                     (poses > 1 ? ", at the median of " + std::to_string(poses) + " poses" : "") + ", at " +
                     frame_text(undistorted) + ". ";
  text += &undistorted == &unbent ? "It bends least, too. " : label_of(unbent) + " bends least. ";
  for (const Mode* m : modes)
    if (m != &undistorted && deform::way_of(m->scheme) == deform::Way::smooth)
      text += "Smooth, which the program takes by itself, distorts " + number(energy(*m)) +
              " times as much, at " + frame_text(*m) + ". ";
  return text + "The fastest is " + label_of(fast) +
         (&fast == &undistorted ? "." : ", at " + frame_text(fast) + ".");
}

Plot volumes_of(const nlohmann::json& row) {
  Plot plot;
  plot.linear = true, plot.across = "share of the way";
  for (const auto& [name, key, color] :
       {std::tuple{"straight", "straight", plot_color::rival}, {"logs", "log_space", plot_color::ours[0]}}) {
    PlotCurve curve{name, color, false, {}};
    const auto& volumes = row[key]["volumes"];
    for (std::size_t i = 0; i < volumes.size(); ++i)
      curve.points.push_back(
          {static_cast<double>(i) / static_cast<double>(volumes.size() - 1), double(volumes[i])});
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

// Draws all at the same scale.
std::string drawn(const std::vector<ShapePicture>& pictures) {
  constexpr double width = 200, height = 170, margin = 6;
  double reach_x = 1e-9, reach_y = 1e-9;
  for (const ShapePicture& picture : pictures)
    for (const auto& [x, y] : picture.dots)
      reach_x = std::max(reach_x, std::abs(x)), reach_y = std::max(reach_y, std::abs(y));
  const double scale = std::min((width / 2 - margin) / reach_x, (height / 2 - margin) / reach_y);
  std::string text;
  for (const ShapePicture& picture : pictures) {
    std::vector<SvgPoint> dots;
    for (const auto& [x, y] : picture.dots) dots.push_back({width / 2 + scale * x, height / 2 - scale * y});
    Svg svg(width, height, "#ffffff");
    svg.dots(dots, "#1f2933", 0.9);
    text += figure(picture.name, svg.document());
  }
  return text.empty() ? "" : "<div class=\"plots small\">" + text + "</div>\n";
}

}  // namespace

Section ways_section(const Figures& figures) {
  Modes modes;
  std::string body, problems, poses;
  for (const Mode& mode : figures.ways.modes) {
    if (mode.problem.empty())
      modes.push_back(&mode);
    else
      problems += paragraph(label_of(mode) + ": " + mode.problem, "note");
  }
  Section section{"ways", "Ours", "Ways of blending", "", "", "", {}};
  section.commands = {"viete bench modes " + shell_word(figures.files.model) + " " +
                      shell_word(figures.files.cage)};
  for (const auto& pose : figures.files.poses) section.commands[0] += " " + shell_word(pose);
  for (const NamedPose& pose : figures.poses) poses += (poses.empty() ? "" : ", ") + pose.name;
  if (modes.empty()) {
    section.body = problems;
    return section;
  }
  section.seen = seen_of(modes, figures.poses.size());
  section.why =
      "A way is a choice of maps, of weights and of what is summed. Less distortion is not everything: Mean "
      "value "
      "follows affine poses exactly, Local leaves what is far away at rest, Paper needs neither a surface "
      "nor a "
      "solver.";
  section.body =
      "<div class=\"plots\">" +
      ways_plot("distortion, times that of mean value coordinates", modes, energy, "") +
      ways_plot("ms a frame, one thread", modes, frame, " ms") + "</div>\n" + html(ways_table(modes)) +
      problems +
      paragraph(
          "Poses: " + poses +
              ". Energy: symmetric Dirichlet energy of the triangles; bending: that of "
              "the angles between them (discrete shells); both over those of mean value coordinates, "
              "medians. Volume: over that at rest. Gap: how far the surface is from where the cage nearby "
              "has gone; torn: how far apart goes what lies together at rest; in % of the diagonal.",
          "note") +
      "<details><summary>What the ways do</summary>" + html(meaning_of_ways(modes)) + "</details>\n";
  return section;
}

Section shapes_section(const Figures& figures) {
  Section section{
      "shapes", "Ours", "Between shapes", "", "", drawn(figures.pictures) + "<div class=\"plots\">", {}};
  HtmlTable table{
      {"halfway to", "volume, logs", "volume, straight", "edges off, logs", "edges off, straight"}, {}};
  Plot edges;
  edges.unit = " %", edges.compared = false;
  for (const auto& row : figures.shapes) {
    const std::string name = name_of_shape(row);
    section.body += figure("volume on the way to " + name, draw_curves(volumes_of(row)));
    edges.bars.push_back({name + ", straight", 100 * double(row["straight"]["edges"]), plot_color::rival});
    edges.bars.push_back({name + ", logs", 100 * double(row["log_space"]["edges"]), plot_color::ours[0]});
    const auto cell = [&](const char* way, const char* what) {
      return percent(100 * double(row[way][what]));
    };
    table.rows.push_back({name, cell("log_space", "volume"), cell("straight", "volume"),
                          cell("log_space", "edges"), cell("straight", "edges")});
  }
  section.body += figure("edges off halfway, %", draw_bars(edges)) + "</div>\n" + html(table) +
                  paragraph(
                      "Volume over that of the smaller end. Edges: off the geometric mean of their lengths "
                      "at both ends, root mean "
                      "square of logarithms. Shapes of the dragon that comes with the program.",
                      "note");
  if (const auto* most = most_lost(figures.shapes)) {
    const auto &straight = (*most)["straight"], &logs = (*most)["log_space"];
    section.seen = "Halfway to " + name_of_shape(*most) + ", straight lines lose " + lost_volume(straight) +
                   " of the volume, and edges are " + percent(100 * double(straight["edges"])) +
                   " off. In log space " + lost_volume(logs) + " is lost, and edges are " +
                   percent(100 * double(logs["edges"])) + " off.";
  }
  section.why =
      "On a straight line each point goes the shortest way. Where a part turns by half a turn, that way "
      "leads "
      "through its axis: all points of it meet there, and the part collapses. Logarithms add the turn "
      "itself, "
      "so that each triangle turns about the axis and keeps its size.";
  return section;
}

std::vector<Section> sections_of(const Figures& figures) {
  return {eigenvalues_section(figures), exponentials_section(figures), deformation_section(figures),
          paper_section(figures),       accuracy_section(figures),     frames_section(figures),
          ways_section(figures),        shapes_section(figures)};
}

}  // namespace viete::bench
