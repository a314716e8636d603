#include "bench/svg.h"

#include <cstdarg>
#include <cstdio>

namespace viete::bench {

namespace {

[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace

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

Svg::Svg(double width, double height, const char* background) {
  body_ = formatted(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" width=\"%g\" height=\"%g\" "
      "font-family=\"Inter, 'Helvetica Neue', Arial, sans-serif\">\n"
      "<rect width=\"100%%\" height=\"100%%\" fill=\"%s\"/>\n",
      width, height, width, height, background);
}

void Svg::text(SvgPoint at, std::string_view text, const SvgText& style) {
  body_ += formatted("<text x=\"%.1f\" y=\"%.1f\" fill=\"%s\" font-size=\"%g\" text-anchor=\"%s\"", at.x,
                     at.y, style.color, style.size, style.anchor);
  if (style.strong) body_ += " font-weight=\"600\"";
  if (style.turn != 0) body_ += formatted(" transform=\"rotate(%g %.1f %.1f)\"", style.turn, at.x, at.y);
  body_ += ">" + escaped(text) + "</text>\n";
}

void Svg::line(SvgPoint from, SvgPoint to, const char* color, double width) {
  body_ +=
      formatted("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"%g\"/>\n",
                from.x, from.y, to.x, to.y, color, width);
}

void Svg::curve(std::span<const SvgPoint> points, const char* color, double width, bool dashed) {
  body_ += formatted(
      "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"%g\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"round\"",
      color, width);
  if (dashed) body_ += " stroke-dasharray=\"1.5 5\"";
  body_ += " points=\"";
  for (const SvgPoint& p : points) body_ += formatted("%.1f,%.1f ", p.x, p.y);
  body_ += "\"/>\n";
}

void Svg::disc(SvgPoint center, double radius, const char* color) {
  body_ += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%g\" fill=\"%s\"/>\n", center.x, center.y, radius,
                     color);
}

void Svg::dots(std::span<const SvgPoint> centers, const char* color, double size) {
  body_ += formatted("<path fill=\"none\" stroke=\"%s\" stroke-width=\"%g\" stroke-linecap=\"round\" d=\"",
                     color, size);
  for (const SvgPoint& p : centers) body_ += formatted("M%.1f %.1fh0", p.x, p.y);
  body_ += "\"/>\n";
}

void Svg::bar(SvgPoint corner, double width, double height, const char* color) {
  body_ += formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" rx=\"2\" fill=\"%s\"/>\n",
                     corner.x, corner.y, width, height, color);
}

}  // namespace viete::bench
