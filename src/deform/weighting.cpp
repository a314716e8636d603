#include "deform/weighting.h"

#include <charconv>

namespace viete::deform {

std::string_view name(Coordinates coordinates) {
  return coordinates == Coordinates::face ? "face" : "mvc";
}

std::optional<Coordinates> coordinates_from_name(std::string_view word) {
  for (const auto c : {Coordinates::face, Coordinates::mean_value}) {
    if (name(c) == word) return c;
  }
  return std::nullopt;
}

std::string text_of_reach(double reach) {
  if (!(reach < whole_cage)) return "all";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, reach).ptr};
}

std::optional<double> reach_from_text(std::string_view text) {
  if (text == "all") return whole_cage;
  double reach = 0;
  const auto end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, reach);
  if (code != std::errc() || stop != end || !(reach >= lowest_reach && reach < whole_cage))
    return std::nullopt;
  return reach;
}

}  // namespace viete::deform
