#include "deform/scheme.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/error.h"

namespace viete::deform {

namespace {

constexpr std::array elements_table = {
    ElementsEntry{Elements::face, "face", "an affine map per cage triangle, of its edges and its normal",
                  "faces", true},
    ElementsEntry{Elements::point, "point", "a translation per cage vertex", "vertices", false},
};

constexpr std::array weights_table = {
    WeightsEntry{Weights::inverse, "inverse", "1/d^2, d the distance to the element, as far as it reaches",
                 "constants", true},
    WeightsEntry{Weights::mean_value, "mean-value", "mean value coordinates of the cage's vertices",
                 "linear functions, in closed cages", false},
};

constexpr std::array blend_table = {
    BlendEntry{Blend::srl, "srl", "logs of stretches and of rotations, about the blended centre",
               "similarities, also after whole turns", 12, true},
    BlendEntry{Blend::linear, "linear", "the maps themselves are averaged", "similarities", 12, false},
};

constexpr std::array combination_table = {
    Combination{
        Elements::face, Weights::inverse, Blend::srl, "face", "scheme_log", "Faces, log space",
        "Each cage triangle carries an affine map; rotations and stretches are blended as logarithms with "
        "weights 1/d^2, so that any number of turns is followed."},
    Combination{
        Elements::face, Weights::inverse, Blend::linear, "", "scheme_linear", "Faces, linear",
        "The same maps and weights, but the maps themselves are averaged, without an exponential: between "
        "parts that are turned against each other the model caves in."},
    Combination{Elements::point, Weights::mean_value, Blend::linear, "mvc", "scheme_mvc", "Mean value",
                "Positions of cage vertices are blended with mean value coordinates. Smooth, linear, no "
                "exponential."},
};

template <class Table, class Value>
const auto& find(const Table& table, Value value) {
  return *std::find_if(table.begin(), table.end(), [&](const auto& e) { return e.value == value; });
}

std::string words(const Combination& c) {
  return "--elements " + std::string(entry(c.elements).name) + " --weights " +
         std::string(entry(c.weights).name) + " --blend " + std::string(entry(c.blend).name);
}

}  // namespace

std::span<const ElementsEntry> all_elements() {
  return elements_table;
}
std::span<const WeightsEntry> all_weights() {
  return weights_table;
}
std::span<const BlendEntry> all_blends() {
  return blend_table;
}
const ElementsEntry& entry(Elements elements) {
  return find(elements_table, elements);
}
const WeightsEntry& entry(Weights weights) {
  return find(weights_table, weights);
}
const BlendEntry& entry(Blend blend) {
  return find(blend_table, blend);
}

std::span<const Combination> combinations() {
  return combination_table;
}

const Combination& combination_of(const Scheme& scheme) {
  return *std::find(combination_table.begin(), combination_table.end(), scheme);
}

const Combination* combination_of_shorthand(std::string_view word) {
  const auto found = std::find_if(combination_table.begin(), combination_table.end(),
                                  [&](const auto& c) { return !c.shorthand.empty() && c.shorthand == word; });
  return found == combination_table.end() ? nullptr : &*found;
}

Scheme with(const Scheme& scheme, const Combination& c) {
  return {{c.elements, c.weights, scheme.weighting.reach}, c.blend};
}

const Combination& complete(const PartialChoice& choice, const Scheme& preferred) {
  const Combination* best = nullptr;
  int most = -1;
  for (const Combination& c : combination_table) {
    if (c.elements != choice.elements.value_or(c.elements) ||
        c.weights != choice.weights.value_or(c.weights) || c.blend != choice.blend.value_or(c.blend))
      continue;
    const int kept = (c.elements == preferred.weighting.elements) +
                     (c.weights == preferred.weighting.weights) + (c.blend == preferred.blend);
    if (kept > most) best = &c, most = kept;
  }
  if (best) return *best;
  std::string all;
  for (const Combination& c : combination_table) all += (all.empty() ? "" : "; ") + words(c);
  throw base::Error("", "these elements, weights and blend do not go together", "choose one of: " + all);
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
