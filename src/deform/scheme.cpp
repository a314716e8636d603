#include "deform/scheme.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "base/error.h"

namespace viete::deform {

namespace {

constexpr std::array weights_table = {
    WeightsEntry{{"inverse", "Inverse distance", "1/d^2 with d the distance to the element"},
                 Weights::inverse},
    WeightsEntry{{"cutoff", "Cut-off", "(1 - d/radius)^2 within the radius, 0 beyond it"}, Weights::cut_off},
    WeightsEntry{{"harmonic", "Harmonic",
                  "harmonic along the model's surface, 1 at the vertex nearest to the element"},
                 Weights::harmonic,
                 true},
    WeightsEntry{
        {"biharmonic", "Biharmonic",
         "biharmonic along the model's surface, smoother than harmonic; negative values are set to 0"},
        Weights::biharmonic,
        true},
    WeightsEntry{{"mean-value", "Mean value (MVC)", "mean value coordinates of the cage's vertices"},
                 Weights::mean_value},
};

constexpr std::array blend_table = {
    BlendEntry{{"srl", "Log space", "sums logarithms of rotation and stretch about the blended centre"},
               Blend::srl},
    BlendEntry{
        {"mls-affine", "Least squares (MLS)", "affine map fitted by least squares"}, Blend::mls_affine, true},
    BlendEntry{
        {"mls-similarity", "Least squares, similar", "rotation and uniform scale fitted by least squares"},
        Blend::mls_similarity,
        true},
    BlendEntry{
        {"mls-rigid", "Least squares, rigid", "rotation fitted by least squares"}, Blend::mls_rigid, true},
    BlendEntry{{"linear", "Linear (LBS)", "weighted mean of the maps"}, Blend::linear},
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
    return "mean value coordinates move points and need the blend linear";
  if (scheme.stitched() && !scheme.has_maps())
    return "cage vertices give no maps that triangles could follow, so stitching is not possible";
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
  const double percent = std::round(1e8 * fraction) / 1e6;  // as typed
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

namespace {

constexpr Scheme scheme(Elements elements, Weights weights, Blend blend, int iterations = 0) {
  Scheme s;
  s.weighting.elements = elements;
  s.weighting.weights = weights;
  s.blend = blend;
  s.iterations = iterations;
  return s;
}

constexpr std::array ways_table = {
    WayEntry{
        {"smooth", "Smooth", "weights along the surface, maps blended in log space: best for most models"},
        Way::smooth,
        scheme(Elements::face, Weights::biharmonic, Blend::srl)},
    WayEntry{
        {"paper", "As published", "the paper's method: inverse-distance weights, maps blended in log space"},
        Way::paper,
        scheme(Elements::face, Weights::inverse, Blend::srl)},
    WayEntry{{"mean-value", "Mean value",
              "mean value coordinates: exact for affine poses, loses volume where parts rotate"},
             Way::mean_value,
             scheme(Elements::point, Weights::mean_value, Blend::linear)},
    WayEntry{{"rigid", "Rigid", "rigid least squares: rotates without stretching, keeps sizes of details"},
             Way::rigid,
             scheme(Elements::point, Weights::biharmonic, Blend::mls_rigid)},
    WayEntry{{"arap", "As rigid as possible",
              "global as-rigid-as-possible solve: preserves details best, slower frames"},
             Way::arap,
             scheme(Elements::face, Weights::biharmonic, Blend::srl, 1)},
    WayEntry{{"local", "Local", "weights end at a radius: vertices out of reach stay at rest"},
             Way::local,
             scheme(Elements::face, Weights::cut_off, Blend::srl)},
};

bool same_choices(const Scheme& a, const Scheme& b) {
  return a.weighting.weights == b.weighting.weights && a.blend == b.blend;
}

}  // namespace

std::span<const WayEntry> all_ways() {
  return ways_table;
}
const WayEntry& entry(Way way) {
  return ways_table[static_cast<std::size_t>(way)];
}

Scheme scheme_of(Way way, const Scheme& now) {
  Scheme s = entry(way).scheme;
  s.amounts = now.amounts;
  return s;
}

std::optional<Way> way_of(const Scheme& s) {
  const auto is_it = [&](const WayEntry& way) {
    return same_choices(s, way.scheme) && s.stitched() == way.scheme.stitched();
  };
  const auto found = std::ranges::find_if(ways_table, is_it);
  return found == ways_table.end() ? std::nullopt : std::optional(found->value);
}

Scheme default_scheme(bool has_triangles) {
  return entry(has_triangles ? Way::smooth : Way::paper).scheme;
}

Scheme complete(const PartialChoice& choice, const Scheme& preferred) {
  Scheme s = preferred;
  s.iterations = 0;
  s.weighting.weights = choice.weights.value_or(preferred.weighting.weights);
  s.blend = choice.blend.value_or(preferred.blend);
  if (conflict(s) && !choice.blend) s.blend = Blend::linear;
  if (conflict(s) && !choice.weights) s.weighting.weights = Weights::inverse;
  if (const auto reason = conflict(s))
    throw base::Error("", "these weights and this blend cannot be combined: " + std::string(*reason),
                      "omit one of them to have it chosen automatically");
  s.weighting.elements = elements_of(s.weighting.weights, s.blend);
  if (s.has_maps()) s.iterations = preferred.iterations;
  return s;
}

Scheme scheme_of(const AskedScheme& asked, const Scheme& now, bool chosen) {
  Scheme scheme = asked.way ? scheme_of(*asked.way, now) : now;
  PartialChoice choice = asked.choice;
  if (asked.radius && !chosen && !asked.way && !choice.weights) choice.weights = Weights::cut_off;
  if (choice.any()) scheme = complete(choice, scheme);
  scheme.weighting.radius = asked.radius.value_or(scheme.weighting.radius);
  if (asked.radius && !scheme.weighting.partial())
    throw base::Error("--radius", "these weights have no radius", "omit it, or choose --weights cutoff");
  if ((asked.turn || asked.stretch) && !scheme.has_maps()) {
    throw base::Error(asked.turn ? "--turn" : "--stretch",
                      "this deformer does not use rotation or stretch of the cage",
                      "omit it, or choose another deformer or blend");
  }
  scheme.amounts.turn = asked.turn.value_or(scheme.amounts.turn);
  scheme.amounts.stretch = asked.stretch.value_or(scheme.amounts.stretch);
  if (asked.iterations) scheme.iterations = *asked.iterations;
  scheme.holding.radius = asked.pins.value_or(scheme.holding.radius);
  scheme.holding.weight = asked.hold.value_or(scheme.holding.weight);
  if ((asked.pins || asked.hold) && !scheme.stitched())
    throw base::Error(asked.pins ? "--pins" : "--hold", "this option needs a stitched model",
                      "omit it, or add --stitched");
  if (const auto reason = conflict(scheme))
    throw base::Error("--stitched", std::string(*reason), "omit it, or choose another deformer or blend");
  return scheme;
}

EngineKind engine_for(const Scheme& scheme, sym3::Method method, bool same_path) {
  if (scheme.stitched()) return EngineKind::stitched;
  const bool fuses = !scheme.exponential() || (method == sym3::Method::fast && !same_path);
  return fuses ? EngineKind::fused : EngineKind::staged;
}

}  // namespace viete::deform
