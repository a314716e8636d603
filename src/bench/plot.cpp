#include "bench/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/quantity.h"
#include "bench/svg.h"

namespace viete::bench {

namespace {

constexpr double width = 1000, top = 116;
constexpr const char *paper = "#ffffff", *ink = "#1f2933", *faint = "#6b7785", *rule = "#e4e8ec";

std::string count_text(double count) {
  char text[32];
  if (count >= 1e6) {
    std::snprintf(text, sizeof text, "%g M", count / 1e6);
  } else if (count >= 1e3) {
    std::snprintf(text, sizeof text, "%g k", count / 1e3);
  } else {
    std::snprintf(text, sizeof text, "%g", count);
  }
  return text;
}

struct Area {
  double left, top, right, bottom;
};

void draw_bars(Svg& svg, const Plot& plot, const Area& area) {
  svg.text({area.left, area.top - 22}, plot.bars_title, {.size = 13, .strong = true});
  const double label = 118, room = 104;
  double longest = 0;
  for (const PlotBar& bar : plot.bars) longest = std::max(longest, bar.ns);
  const double step = (area.bottom - area.top) / static_cast<double>(plot.bars.size());
  const double height = std::min(26.0, 0.62 * step), full = area.right - area.left - label - room;
  double middle = area.top + 0.5 * step;
  svg.line({area.left + label, area.top}, {area.left + label, area.bottom}, rule, 1);
  for (const PlotBar& bar : plot.bars) {
    const double length = std::max(1.5, full * bar.ns / longest), start = area.left + label;
    svg.text({start - 10, middle + 4}, bar.name, {.anchor = "end"});
    svg.bar({start, middle - 0.5 * height}, length, height, bar.color);
    const std::string value = base::few_digits(bar.ns);
    svg.text({start + length + 8, middle + 4}, value + " ns", {.strong = true});
    if (&bar != plot.bars.data()) {
      const double x = start + length + 26 + 7.5 * static_cast<double>(value.size()) + 16;
      svg.text({x, middle + 4}, base::few_digits(plot.bars.front().ns / bar.ns) + " x", {.color = faint});
    }
    middle += step;
  }
}

/// From a value on a logarithmic scale to a place.
struct LogScale {
  double low, high, from, to;  ///< decades, pixels

  double operator()(double value) const {
    return from + (to - from) * (std::log10(value) - low) / (high - low);
  }
};

LogScale scale_of(const std::vector<PlotCurve>& curves, double PlotCurve::Point::*value, double from,
                  double to) {
  double low = 1e300, high = 0;
  for (const PlotCurve& curve : curves) {
    for (const auto& p : curve.points) low = std::min(low, p.*value), high = std::max(high, p.*value);
  }
  return {std::log10(low) - 0.06, std::log10(high) + 0.06, from, to};
}

void draw_grid(Svg& svg, const LogScale& x, const LogScale& y, const Area& area) {
  for (double decade = std::floor(y.low); decade <= y.high; ++decade) {
    for (const double times : {1.0, 2.0, 5.0}) {
      const double value = times * std::pow(10, decade);
      if (std::log10(value) < y.low || std::log10(value) > y.high) continue;
      svg.line({area.left, y(value)}, {area.right, y(value)}, rule, times == 1 ? 1.5 : 0.75);
      svg.text({area.left - 8, y(value) + 4}, count_text(value),
               {.color = faint, .size = 11, .anchor = "end"});
    }
  }
  for (double decade = std::ceil(x.low); decade <= x.high; ++decade) {
    const double value = std::pow(10, decade);
    svg.line({x(value), area.bottom}, {x(value), area.bottom + 5}, faint, 1);
    svg.text({x(value), area.bottom + 20}, count_text(value),
             {.color = faint, .size = 11, .anchor = "middle"});
  }
  svg.line({area.left, area.bottom}, {area.right, area.bottom}, faint, 1);
  svg.text({0.5 * (area.left + area.right), area.bottom + 40}, "matrices in a batch",
           {.color = faint, .anchor = "middle"});
}

/// Names at the ends of the curves, moved apart so that none covers another.
void draw_names(Svg& svg, const std::vector<PlotCurve>& curves, const LogScale& y, double x, double bottom) {
  struct Name {
    const PlotCurve* curve;
    double at;
  };
  std::vector<Name> names;
  for (const PlotCurve& curve : curves) names.push_back({&curve, y(curve.points.back().ns)});
  std::sort(names.begin(), names.end(), [](const Name& a, const Name& b) { return a.at < b.at; });
  constexpr double line = 16;
  for (std::size_t i = 1; i < names.size(); ++i) names[i].at = std::max(names[i].at, names[i - 1].at + line);
  double limit = bottom;
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    name->at = std::min(name->at, limit);
    limit = name->at - line;
  }
  for (const Name& name : names) {
    const std::string value = base::few_digits(name.curve->points.back().ns);
    svg.text({x, name.at + 4}, name.curve->name, {.color = name.curve->color, .strong = !name.curve->dashed});
    svg.text({width - 32, name.at + 4}, value,
             {.color = name.curve->color, .anchor = "end", .strong = !name.curve->dashed});
  }
}

void draw_curves(Svg& svg, const Plot& plot, const Area& area) {
  svg.text({area.left - 34, area.top - 22}, plot.curves_title, {.size = 13, .strong = true});
  const LogScale x = scale_of(plot.curves, &PlotCurve::Point::count, area.left, area.right);
  const LogScale y = scale_of(plot.curves, &PlotCurve::Point::ns, area.bottom, area.top);
  draw_grid(svg, x, y, area);
  for (const PlotCurve& curve : plot.curves) {
    std::vector<SvgPoint> points;
    for (const auto& p : curve.points) points.push_back({x(p.count), y(p.ns)});
    svg.curve(points, curve.color, curve.dashed ? 2 : 2.5, curve.dashed);
    if (curve.dashed) continue;
    for (const SvgPoint& p : points) svg.disc(p, 3.5, curve.color);
  }
  draw_names(svg, plot.curves, y, area.right + 12, area.bottom);
}

}  // namespace

std::string draw_plot(const Plot& plot) {
  const double bottom = top + std::max(330.0, 36.0 * static_cast<double>(plot.bars.size()));
  Svg svg(width, bottom + 64, paper);
  svg.text({32, 42}, plot.title, {.color = ink, .size = 20, .strong = true});
  svg.text({32, 64}, plot.subtitle, {.color = faint, .size = 12.5});
  draw_bars(svg, plot, {32, top, plot.curves.empty() ? width - 32 : 452, bottom});
  if (!plot.curves.empty()) draw_curves(svg, plot, {528, top, 838, bottom});
  return svg.document();
}

}  // namespace viete::bench
