// The benchmarks as SVG pictures: bars of times beside curves of time against size.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

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

struct PlotBar {
  std::string name;
  double ns = 0;
  const char* color;
  double part = 0;  ///< of it, which alone has the colour then; 0: all of it has
};

struct PlotCurve {
  std::string name;
  const char* color;
  bool dashed = false;
  struct Point {
    double count, ns;
  };
  std::vector<Point> points;  ///< by count, ascending
};

struct Plot {
  std::string title, subtitle;
  std::string bars_title;
  std::vector<PlotBar> bars;  ///< the first is what the others are compared with
  std::string curves_title;
  std::vector<PlotCurve> curves;
  std::string unit = " ns";  ///< of bars; curves are of the same, or of what their title says
  bool compared = true;      ///< bars with the first one
  std::string across = "matrices in a batch";
  bool linear = false;  ///< curves from 0 to 1, without values at their ends; else both axes are logarithmic,
                        ///< and what is not above 0 is not drawn
};

/// Colours that stay apart for colour-blind eyes and in grey (Okabe and Ito's, darkened for white paper).
namespace plot_color {
inline constexpr const char* reference = "#6b7785";
inline constexpr const char* rival = "#c77700";
inline constexpr const char* copy = "#9aa5b1";
inline constexpr const char* rest = "#cfd6dd";  ///< of a bar, beside its part
inline constexpr const char* ours[] = {"#0072b2", "#009e73", "#b3589a", "#3a3f9e"};
}  // namespace plot_color

/// The same for a method in every plot; of others that of what ours is compared with.
const char* color_of_method(const std::string& name);

/// "4.3e-16".
std::string error_text(double error);

/// An SVG document, 1000 pixels wide.
std::string draw_plot(const Plot& plot);
/// The bars, or the curves, by themselves, 400 pixels wide and without titles.
std::string draw_bars(const Plot& plot);
std::string draw_curves(const Plot& plot);

}  // namespace viete::bench
