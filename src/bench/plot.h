// Benchmarks as SVG pictures: bars for times, and curves for times by size.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace viete::bench {

/// Escapes `&`, `<`, `>` and `"` for text and attributes of XML.
std::string escaped(std::string_view text);

struct PlotBar {
  std::string name;
  double ns = 0;
  const char* color;
  double part = 0;  ///< length of the coloured part, in the unit of `ns`; 0 colours the whole bar
};

struct PlotCurve {
  std::string name;
  const char* color;
  bool dashed = false;
  struct Point {
    double count, ns;
  };
  std::vector<Point> points;  ///< in ascending order of count
};

struct Plot {
  std::vector<PlotBar> bars;  ///< the first bar is the reference
  std::vector<PlotCurve> curves;
  std::string unit = " ns";  ///< unit of the bars
  bool compared = true;      ///< if true, shows ratios to the first bar
  std::string across = "matrices in a batch";
  /// If true, axes are linear from 0, and names of curves have no values. If false, axes are logarithmic and
  /// skip values of 0 and below.
  bool linear = false;
};

/// Colours that colour-blind readers can distinguish, also in grey (Okabe and Ito, darkened for white paper).
namespace plot_color {
inline constexpr const char* reference = "#6b7785";
inline constexpr const char* rival = "#c77700";
inline constexpr const char* copy = "#9aa5b1";
inline constexpr const char* rest = "#cfd6dd";  ///< the uncoloured part of a bar
inline constexpr const char* ours[] = {"#0072b2", "#009e73", "#b3589a", "#3a3f9e"};
}  // namespace plot_color

/// Returns the colour of a method. It is the same in all plots. Other names get the colour of references.
const char* color_of_method(const std::string& name);

/// Returns an SVG document, 400 pixels wide, with the bars or the curves.
std::string draw_bars(const Plot& plot);
std::string draw_curves(const Plot& plot);

}  // namespace viete::bench
