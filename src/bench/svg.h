// Drawing as SVG text: a few shapes, in order.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace viete::bench {

/// `&`, `<`, `>` and `"` written out, for text and attributes of XML.
std::string escaped(std::string_view text);

struct SvgPoint {
  double x, y;
};

struct SvgText {
  const char* color = "#1f2933";
  double size = 12;
  const char* anchor = "start";  ///< or "middle", "end"
  bool strong = false;
  double turn = 0;  ///< degrees, clockwise
};

/// Lengths in pixels, y down; colours as CSS writes them. y of a text is its baseline.
class Svg {
public:
  Svg(double width, double height, const char* background);

  void text(SvgPoint at, std::string_view text, const SvgText& style = {});
  void line(SvgPoint from, SvgPoint to, const char* color, double width);
  void curve(std::span<const SvgPoint> points, const char* color, double width, bool dashed);
  void disc(SvgPoint center, double radius, const char* color);
  /// Many small round ones, each as wide as `size`.
  void dots(std::span<const SvgPoint> centers, const char* color, double size);
  void bar(SvgPoint corner, double width, double height, const char* color);

  /// The whole document so far.
  std::string document() const { return body_ + "</svg>\n"; }

private:
  std::string body_;
};

}  // namespace viete::bench
