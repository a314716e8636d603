#include "bench/plot.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/text.h"
#include "bench/table.h"
#include "sym3/exp.h"

namespace viete::bench {

using base::formatted;

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
}

namespace {

struct SvgPoint {
  double x, y;
};

struct SvgText {
  const char* color = "#1f2933";
  double size = 12;
  const char* anchor = "start";  ///< "start", "middle" or "end"
  bool strong = false;
};

/// A picture. Lengths are in pixels, y points down, colours are as in CSS. The y of a text is the baseline.
class Svg {
public:
  Svg(double width, double height)
      : body_(formatted(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" width=\"%g\" height=\"%g\" "
            "font-family=\"Inter, 'Helvetica Neue', Arial, sans-serif\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
            width, height, width, height)) {}

  void text(SvgPoint at, std::string_view text, const SvgText& style = {}) {
    body_ += formatted("<text x=\"%.1f\" y=\"%.1f\" fill=\"%s\" font-size=\"%g\" text-anchor=\"%s\"", at.x,
                       at.y, style.color, style.size, style.anchor);
    if (style.strong) body_ += " font-weight=\"600\"";
    body_ += ">" + escaped(text) + "</text>\n";
  }

  void line(SvgPoint from, SvgPoint to, const char* color, double width) {
    body_ += formatted(
        "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"%g\"/>\n", from.x,
        from.y, to.x, to.y, color, width);
  }

  void curve(std::span<const SvgPoint> points, const char* color, double width, bool dashed) {
    body_ += formatted(
        "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"%g\" stroke-linejoin=\"round\" "
        "stroke-linecap=\"round\"",
        color, width);
    if (dashed) body_ += " stroke-dasharray=\"1.5 5\"";
    body_ += " points=\"";
    for (const SvgPoint& p : points) body_ += formatted("%.1f,%.1f ", p.x, p.y);
    body_ += "\"/>\n";
  }

  void disc(SvgPoint center, double radius, const char* color) {
    body_ += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%g\" fill=\"%s\"/>\n", center.x, center.y, radius,
                       color);
  }

  void bar(SvgPoint corner, double width, double height, const char* color) {
    body_ += formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" rx=\"2\" fill=\"%s\"/>\n",
                       corner.x, corner.y, width, height, color);
  }

  std::string document() const { return body_ + "</svg>\n"; }

private:
  std::string body_;
};

constexpr double plot_width = 400, letter = 7.7;  // `letter`: assumed width of a letter
constexpr const char *faint = "#6b7785", *rule = "#e4e8ec";

std::string count_text(double count) {
  if (count > 0 && count < 5e-3) {  // a power of ten with superscripts
    constexpr const char* raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                      "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    std::string power = "10\u207b";
    for (const char digit : std::to_string(std::lround(-std::log10(count)))) power += raised[digit - '0'];
    return power;
  }
  if (count >= 1e6) return formatted("%g M", count / 1e6);
  return count >= 1e3 ? formatted("%g k", count / 1e3) : formatted("%g", count);
}

struct Area {
  double left, top, right, bottom;
};

struct Scale {
  bool logarithmic;
  double low, high, from, to;  ///< low and high are values or logarithms; from and to are pixels

  double at(double value) const { return logarithmic ? std::log10(value) : value; }
  double operator()(double value) const { return from + (to - from) * (at(value) - low) / (high - low); }
  bool shows(double value) const { return !logarithmic || value > 0; }
};

Scale scale_of(const Plot& plot, double PlotCurve::Point::*value, double from, double to) {
  double low = 1e300, high = 0;
  for (const PlotCurve& curve : plot.curves)
    for (const auto& p : curve.points)
      if (p.ns > 0 || plot.linear) {
        low = std::min(low, p.*value);
        high = std::max(high, p.*value);
      }
  if (plot.linear) return {false, 0, 1.04 * high, from, to};
  return {true, std::log10(low) - 0.06, std::log10(high) + 0.06, from, to};
}

struct Tick {
  double value;
  bool strong;
};

// Returns a readable number of ticks. If there are few decades, `between` adds ticks inside decades.
std::vector<Tick> ticks(const Scale& scale, bool between) {
  std::vector<Tick> found;
  const double length = scale.high - scale.low;
  if (!scale.logarithmic) {
    for (int i = 0; i * 0.25 <= scale.high; ++i) found.push_back({i * 0.25, i % 4 == 0});
    return found;
  }
  const double step = std::ceil(length / 6.5);
  for (double decade = step * std::floor(scale.low / step); decade <= scale.high; decade += step)
    for (const double times : {1.0, 2.0, 5.0}) {
      const double value = times * std::pow(10, decade);
      if ((times != 1 && (!between || length > 4)) || std::log10(value) < scale.low ||
          std::log10(value) > scale.high)
        continue;
      found.push_back({value, times == 1});
    }
  return found;
}

void draw_grid(Svg& svg, const Plot& plot, const Scale& x, const Scale& y, const Area& area) {
  for (const Tick& tick : ticks(y, true)) {
    svg.line({area.left, y(tick.value)}, {area.right, y(tick.value)}, rule, tick.strong ? 1.5 : 0.75);
    svg.text({area.left - 8, y(tick.value) + 4}, count_text(tick.value),
             {.color = faint, .size = 11, .anchor = "end"});
  }
  for (const Tick& tick : ticks(x, x.high - x.low < 2)) {
    svg.line({x(tick.value), area.bottom}, {x(tick.value), area.bottom + 5}, faint, 1);
    svg.text({x(tick.value), area.bottom + 20}, count_text(tick.value),
             {.color = faint, .size = 11, .anchor = "middle"});
  }
  svg.line({area.left, area.bottom}, {area.right, area.bottom}, faint, 1);
  svg.text({0.5 * (area.left + area.right), area.bottom + 40}, plot.across,
           {.color = faint, .anchor = "middle"});
}

std::string value_text(double value) {
  return value < 1e-3 ? error_text(value) : base::few_digits(value);
}

/// Draws names at the ends of the curves. Moves names apart that would overlap.
void draw_names(Svg& svg, const Plot& plot, const Scale& y, const Area& area) {
  struct Name {
    const PlotCurve* curve;
    double at, value;
  };
  std::vector<Name> names;
  for (const PlotCurve& curve : plot.curves) {
    const double value = curve.points.back().ns;
    names.push_back({&curve, y.shows(value) ? y(value) : area.bottom, value});
  }
  std::sort(names.begin(), names.end(), [](const Name& a, const Name& b) { return a.at < b.at; });
  constexpr double line = 16;
  for (std::size_t i = 1; i < names.size(); ++i) names[i].at = std::max(names[i].at, names[i - 1].at + line);
  double limit = area.bottom;
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    name->at = std::min(name->at, limit);
    limit = name->at - line;
  }
  for (const Name& name : names) {
    const SvgText style{.color = name.curve->color, .strong = !name.curve->dashed};
    SvgText right = style;
    right.anchor = "end";
    svg.text({area.right + 12, name.at + 4}, name.curve->name, style);
    if (!plot.linear) svg.text({plot_width, name.at + 4}, value_text(name.value), right);
  }
}

}  // namespace

const char* color_of_method(const std::string& name) {
  using sym3::label, sym3::Method;
  if (name == label(Method::fast)) return plot_color::ours[0];
  if (name == label(Method::improved_sd)) return plot_color::rival;
  return name == label(Method::sd) ? plot_color::ours[2] : plot_color::reference;
}

std::string draw_bars(const Plot& plot) {
  constexpr double room = 104, step = 30, height = 0.62 * step;
  const double bottom = step * static_cast<double>(plot.bars.size());
  std::size_t letters = 0;
  double longest = 0;
  for (const PlotBar& bar : plot.bars) {
    letters = std::max(letters, bar.name.size());
    longest = std::max(longest, bar.ns);
  }
  const double start = 16 + letter * static_cast<double>(letters), full = plot_width - start - room;
  double middle = 0.5 * step;
  Svg svg(plot_width, bottom);
  svg.line({start, 0}, {start, bottom}, rule, 1);
  for (const PlotBar& bar : plot.bars) {
    const double length = std::max(1.5, full * bar.ns / longest);
    const double share = bar.part > 0 ? bar.part / bar.ns : 1;
    svg.text({start - 10, middle + 4}, bar.name, {.anchor = "end"});
    if (share < 1) svg.bar({start, middle - 0.5 * height}, length, height, plot_color::rest);
    svg.bar({start, middle - 0.5 * height}, std::max(1.5, share * length), height, bar.color);
    const std::string value = base::few_digits(bar.ns);
    svg.text({start + length + 8, middle + 4}, value + plot.unit, {.strong = true});
    if (plot.compared && &bar != plot.bars.data()) {
      const double x = start + length + 26 + 7.5 * static_cast<double>(value.size()) + 16;
      svg.text({x, middle + 4}, base::few_digits(plot.bars.front().ns / bar.ns) + " x", {.color = faint});
    }
    middle += step;
  }
  return svg.document();
}

std::string draw_curves(const Plot& plot) {
  constexpr double height = 270;
  std::size_t name = 0, value = 0;
  for (const PlotCurve& curve : plot.curves) {
    name = std::max(name, curve.name.size());
    if (!plot.linear) value = std::max(value, value_text(curve.points.back().ns).size());
  }
  const Area area{40, 8, plot_width - 16 - letter * static_cast<double>(name + value + 1), height - 48};
  const Scale x = scale_of(plot, &PlotCurve::Point::count, area.left, area.right);
  const Scale y = scale_of(plot, &PlotCurve::Point::ns, area.bottom, area.top);
  Svg svg(plot_width, height);
  draw_grid(svg, plot, x, y, area);
  for (const PlotCurve& curve : plot.curves) {
    std::vector<SvgPoint> points;
    for (const auto& p : curve.points)
      if (x.shows(p.count) && y.shows(p.ns)) points.push_back({x(p.count), y(p.ns)});
    svg.curve(points, curve.color, curve.dashed ? 2 : 2.5, curve.dashed);
    if (curve.dashed || plot.linear) continue;
    for (const SvgPoint& p : points) svg.disc(p, 3.5, curve.color);
  }
  draw_names(svg, plot, y, area);
  return svg.document();
}

}  // namespace viete::bench
