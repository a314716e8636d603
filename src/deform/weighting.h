// What decides the weights of a binding: the kind of coordinates, and how far an element of the cage reaches.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace viete::deform {

enum class Coordinates {
  face,        ///< an affine map per cage triangle, weights 1/d^2, blended in log space
  mean_value,  ///< positions of cage vertices, blended; no exponential
};

std::string_view name(Coordinates coordinates);  ///< "face", "mvc": the words of the command line
std::optional<Coordinates> coordinates_from_name(std::string_view name);

/// A reach without end: every element moves every vertex.
inline constexpr double whole_cage = std::numeric_limits<double>::infinity();
/// Below it next to nothing is blended: a vertex would follow one face here and the next one there, and the
/// model would show the cage's edges.
inline constexpr double lowest_reach = 1.5;

/// Coordinates, and for faces the reach of inverse_distance_weights(). Mean value coordinates have none.
struct Weighting {
  Coordinates coordinates;
  double reach;  ///< lowest_reach or more; whole_cage for mean value coordinates

  Weighting(Coordinates c, double r = whole_cage)
      : coordinates(c), reach(c == Coordinates::face ? r : whole_cage) {}
  bool local() const { return reach < whole_cage; }
  friend bool operator==(const Weighting&, const Weighting&) = default;
};

/// "3" or "all", as the command line has it.
std::string text_of_reach(double reach);
/// A number from lowest_reach on, or "all".
std::optional<double> reach_from_text(std::string_view text);

}  // namespace viete::deform
