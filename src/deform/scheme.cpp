#include "deform/scheme.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace viete::deform {

namespace {

constexpr std::array weights_table = {
    WeightsEntry{{"inverse", "Inverse distance", "1/d^2, d the distance to the element"}, Weights::inverse},
    WeightsEntry{{"cutoff", "Cut-off", "(1 - d/radius)^2, and none beyond: what no element reaches stays"},
                 Weights::cut_off},
    WeightsEntry{
        {"harmonic", "Harmonic",
         "1 at the model's vertex nearest to the element, and from there on harmonic along the surface"},
        Weights::harmonic,
        true},
    WeightsEntry{{"biharmonic", "Biharmonic",
                  "as harmonic ones, but a thin plate on springs: smoother; below 0 they count as 0"},
                 Weights::biharmonic,
                 true},
    WeightsEntry{{"mean-value", "Mean value (MVC)", "mean value coordinates of the cage's vertices"},
                 Weights::mean_value},
};

constexpr std::array blend_table = {
    BlendEntry{{"srl", "Log space", "logs of stretches and of rotations, about the blended centre"},
               Blend::srl},
    BlendEntry{{"mls-affine", "Least squares (MLS)",
                "the affine map that moves points as they do, by least squares"},
               Blend::mls_affine,
               true},
    BlendEntry{{"mls-similarity", "Least squares, similar",
                "the rotation and scale that move points most nearly as they do"},
               Blend::mls_similarity,
               true},
    BlendEntry{{"mls-rigid", "Least squares, rigid", "the rotation that moves points most nearly as they do"},
               Blend::mls_rigid,
               true},
    BlendEntry{{"linear", "Linear (LBS)", "the maps themselves are averaged"}, Blend::linear},
};

template <class Table, class Value>
const auto& find(const Table& table, Value value) {
  return *std::find_if(table.begin(), table.end(), [&](const auto& e) { return e.value == value; });
}

}  // namespace

std::string_view name(Elements elements) {
  return elements == Elements::face ? "faces" : "vertices";
}

std::span<const WeightsEntry> all_weights() {
  return weights_table;
}
std::span<const BlendEntry> all_blends() {
  return blend_table;
}
Elements elements_of(Weights weights, Blend blend) {
  return weights == Weights::mean_value || entry(blend).of_points ? Elements::point : Elements::face;
}
const WeightsEntry& entry(Weights weights) {
  return find(weights_table, weights);
}
const BlendEntry& entry(Blend blend) {
  return find(blend_table, blend);
}

std::optional<std::string_view> conflict(const Scheme& scheme) {
  if (scheme.weighting.weights == Weights::mean_value && scheme.blend != Blend::linear)
    return "mean value coordinates only move points, which are blended linearly";
  if (scheme.stitched() && !scheme.has_maps())
    return "points give triangles no maps to follow, so there is nothing to stitch";
  return std::nullopt;
}

bool fits(const PartialChoice& choice, const Scheme& s) {
  return choice.weights.value_or(s.weighting.weights) == s.weighting.weights &&
         choice.blend.value_or(s.blend) == s.blend;
}

std::vector<Scheme> valid_schemes() {
  std::vector<Scheme> all;
  for (const WeightsEntry& w : weights_table) {
    for (const BlendEntry& b : blend_table) {
      const Scheme scheme{{elements_of(w.value, b.value), w.value}, b.value};
      if (!conflict(scheme)) all.push_back(scheme);
    }
  }
  return all;
}

std::string text(const Scheme& s) {
  return std::string(entry(s.weighting.weights).name) + ", " + std::string(entry(s.blend).name) +
         (s.stitched() ? ", stitched" : "");
}

std::string text_of_percent(double fraction) {
  char text[32];
  const double percent = std::round(1e8 * fraction) / 1e6;  // as it was typed
  return std::string(text, std::to_chars(text, text + sizeof text, percent).ptr) + " %";
}

std::optional<double> amount_from_percent(double percent) {
  if (!(percent >= 0 && percent <= 100 * largest_amount)) return std::nullopt;
  return percent / 100;
}

std::optional<double> radius_from_percent(double percent) {
  if (!(percent >= 100 * least_radius && percent <= 100 * largest_radius)) return std::nullopt;
  return percent / 100;
}

std::optional<double> share_from_percent(double percent) {
  if (!(percent >= 0 && percent <= 100)) return std::nullopt;
  return percent / 100;
}

}  // namespace viete::deform
