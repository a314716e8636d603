#include "deform/scheme.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace viete::deform {

namespace {

constexpr std::array elements_table = {
    ElementsEntry{{"face", "Faces", "an affine map per cage triangle, of its edges and its normal"},
                  Elements::face,
                  Handles::faces,
                  true,
                  "similarities"},
    ElementsEntry{{"polygon", "Polygons",
                   "an affine map per polygon of the cage, the mean of its corners': quads are taken alike "
                   "however they are cut"},
                  Elements::polygon,
                  Handles::polygon_faces,
                  true,
                  "similarities"},
    ElementsEntry{{"patch", "Patches", "an affine map per cage triangle, fitted to it and its neighbours"},
                  Elements::patch,
                  Handles::faces,
                  true,
                  "affine poses"},
    ElementsEntry{
        {"vertex-patch", "Vertex patches", "an affine map per cage vertex, fitted to its neighbours"},
        Elements::vertex_patch,
        Handles::vertices,
        true,
        "affine poses"},
    ElementsEntry{{"edge", "Edges", "an affine map per cage edge, of its two faces"},
                  Elements::edge,
                  Handles::edges,
                  true,
                  "similarities"},
    ElementsEntry{{"vertex", "Vertices", "an affine map per cage vertex, of its corners about one normal"},
                  Elements::vertex,
                  Handles::vertices,
                  true,
                  "similarities"},
    ElementsEntry{
        {"vertex-face", "Vertices, by face", "an affine map per cage vertex, of its corners one by one"},
        Elements::vertex_face,
        Handles::vertices,
        true,
        "similarities"},
    ElementsEntry{{"point", "Points", "a point per cage vertex, which only moves"},
                  Elements::point,
                  Handles::vertices,
                  false,
                  "translations"},
};

constexpr std::array weights_table = {
    WeightsEntry{
        {"inverse", "Inverse distance", "1/d^2, d the distance to the element, as far as it reaches"},
        Weights::inverse,
        "constants",
        {.reach = true, .exponent = true}},
    WeightsEntry{
        {"integrated", "Integrated", "1/r^4 integrated over the face, however the cage is cut into faces"},
        Weights::integrated,
        "constants"},
    WeightsEntry{{"cutoff", "Cut-off", "(1 - d/radius)^2, and none beyond: what no element reaches stays"},
                 Weights::cut_off,
                 "constants",
                 {.radius = true, .exponent = true, .normalise = true}},
    WeightsEntry{
        {"harmonic", "Harmonic",
         "1 at the model's vertex nearest to the element, and from there on harmonic along the surface"},
        Weights::harmonic,
        "constants",
        {},
        true},
    WeightsEntry{
        {"biharmonic", "Biharmonic",
         "as harmonic ones, but a thin plate on springs: smoother, and outside [0, 1] here and there"},
        Weights::biharmonic,
        "constants",
        {.clamp = true},
        true},
    WeightsEntry{{"mean-value", "Mean value (MVC)", "mean value coordinates of the cage's vertices"},
                 Weights::mean_value,
                 "linear functions, in closed cages"},
};

constexpr std::array blend_table = {
    BlendEntry{{"srl", "Log space", "logs of stretches and of rotations, about the blended centre"},
               Blend::srl,
               true,
               true},
    BlendEntry{
        {"sse", "Screws", "logs of stretches, and of rotations and translations in one: screw motions"},
        Blend::sse,
        true,
        false},
    BlendEntry{{"slrl", "Logs of turns", "stretches averaged, logs of rotations"}, Blend::slrl, false, true},
    BlendEntry{
        {"sql", "Quaternions", "stretches averaged, rotations as unit quaternions"}, Blend::sql, false, true},
    BlendEntry{
        {"log3", "Matrix logs", "logs of the whole maps, turn and stretch in one"}, Blend::log3, false, true},
    BlendEntry{
        {"log4", "Affine logs", "logs of the whole maps with their translations"}, Blend::log4, false, false},
    BlendEntry{{"mls-affine", "Least squares (MLS)",
                "the affine map that moves points as they do, by least squares"},
               Blend::mls_affine,
               false,
               true,
               true},
    BlendEntry{{"mls-similarity", "Least squares, similar",
                "the rotation and scale that move points most nearly as they do"},
               Blend::mls_similarity,
               false,
               true,
               true},
    BlendEntry{{"mls-rigid", "Least squares, rigid", "the rotation that moves points most nearly as they do"},
               Blend::mls_rigid,
               false,
               true,
               true},
    BlendEntry{{"linear", "Linear (LBS)", "the maps themselves are averaged"}, Blend::linear, false, false},
};

template <class Table, class Value>
const auto& find(const Table& table, Value value) {
  return *std::find_if(table.begin(), table.end(), [&](const auto& e) { return e.value == value; });
}

// What does not go together, and why.
struct Rule {
  bool (*breaks)(const ElementsEntry&, const WeightsEntry&, const BlendEntry&);
  std::string_view reason;
};
constexpr std::array rules = {
    Rule{[](const ElementsEntry& e, const WeightsEntry& w, const BlendEntry&) {
           return w.value == Weights::mean_value && e.handles != Handles::vertices;
         },
         "mean values belong to vertices of the cage, and these elements are its faces or edges"},
    Rule{[](const ElementsEntry& e, const WeightsEntry& w, const BlendEntry&) {
           return w.value == Weights::integrated && !of_triangles(e.handles);
         },
         "integrals over faces are weights of faces, and these elements are edges or vertices of the cage"},
    Rule{[](const ElementsEntry& e, const WeightsEntry&, const BlendEntry& b) {
           return e.affine && b.of_points;
         },
         "least squares fit maps to points, and these elements have maps already"},
    Rule{[](const ElementsEntry& e, const WeightsEntry& w, const BlendEntry& b) {
           return !e.affine && !b.of_points &&
                  (w.value == Weights::inverse || w.value == Weights::cut_off || w.on_surface);
         },
         "translations need weights that reproduce linear functions, as mean values do"},
    Rule{[](const ElementsEntry& e, const WeightsEntry& w, const BlendEntry& b) {
           return w.value == Weights::mean_value && b.about_center && (e.affine || b.of_points);
         },
         "about the mean value of its centres a vertex has nothing left to turn: it would move as by points"},
    Rule{[](const ElementsEntry& e, const WeightsEntry&, const BlendEntry& b) {
           return !e.affine && !b.of_points && b.value != Blend::linear;
         },
         "translations have no logarithms, and are blended linearly"},
};

bool breaks(const Rule& rule, const Scheme& s) {
  return rule.breaks(entry(s.weighting.elements), entry(s.weighting.weights), entry(s.blend));
}

// Whether they go together or not, in the order of the tables.
std::vector<Scheme> every_scheme() {
  std::vector<Scheme> all;
  for (const ElementsEntry& e : elements_table) {
    for (const WeightsEntry& w : weights_table) {
      for (const BlendEntry& b : blend_table) all.push_back({{e.value, w.value}, b.value});
    }
  }
  return all;
}

}  // namespace

std::string_view name(Handles handles) {
  switch (handles) {
    case Handles::faces:
    case Handles::polygon_faces: return "faces";
    case Handles::edges: return "edges";
    case Handles::vertices: break;
  }
  return "vertices";
}

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
Elements weighed_as(Elements elements) {
  const ElementsEntry& e = entry(elements);
  return std::ranges::find_if(elements_table,
                              [&](const auto& o) { return o.handles == e.handles && o.affine == e.affine; })
      ->value;
}
Weighting with(Weighting w, const AskedWeighting& asked) {
  w.reach = asked.reach.value_or(w.reach);
  w.radius = asked.radius.value_or(w.radius);
  w.exponent = asked.exponent.value_or(w.exponent);
  w.clamp = asked.clamp.value_or(w.clamp);
  w.normalise = w.normalise || asked.normalise;
  return w;
}

std::optional<UnusedSetting> unused_setting(Weights weights, const AskedWeighting& asked) {
  const WeightSettings& has = entry(weights).has;
  if (asked.reach && !has.reach)
    return UnusedSetting{"--reach", "these weights have no reach: all of the cage moves all of the model",
                         "leave it out, or choose --weights inverse"};
  if (asked.radius && !has.radius)
    return UnusedSetting{"--radius", "these weights have no radius",
                         "leave it out, or choose --weights cutoff"};
  if (asked.exponent && !has.exponent)
    return UnusedSetting{"--exponent", "these weights are no powers of distances",
                         "leave it out, or choose --weights inverse"};
  if (asked.clamp && !has.clamp)
    return UnusedSetting{"--clamp",
                         "these weights are never below 0, or would not be what they are without that",
                         "leave it out, or choose --weights biharmonic"};
  if (asked.normalise && !has.normalise)
    return UnusedSetting{"--normalise", "these weights always sum to 1", "leave it out"};
  return std::nullopt;
}

bool Weighting::same_numbers(const Weighting& o) const {
  return used_reach() == o.used_reach() && used_radius() == o.used_radius() &&
         used_exponent() == o.used_exponent() && used_clamp() == o.used_clamp() &&
         used_normalise() == o.used_normalise() && used_as_before() == o.used_as_before();
}
const WeightsEntry& entry(Weights weights) {
  return find(weights_table, weights);
}
const BlendEntry& entry(Blend blend) {
  return find(blend_table, blend);
}

bool Scheme::changed_in_03() const {
  const bool fits_patches = weighting.elements == Elements::patch ||
                            weighting.elements == Elements::vertex_patch || entry(blend).of_points;
  return stitched() || fits_patches || weighting.changed_in_03();
}

std::optional<std::string_view> conflict(const Scheme& scheme) {
  for (const Rule& rule : rules) {
    if (breaks(rule, scheme)) return rule.reason;
  }
  if (scheme.stitched() && !entry(scheme.weighting.elements).affine)
    return "points give triangles no maps to follow, so there is nothing to stitch";
  return std::nullopt;
}

bool fits(const PartialChoice& choice, const Scheme& s) {
  return choice.elements.value_or(s.weighting.elements) == s.weighting.elements &&
         choice.weights.value_or(s.weighting.weights) == s.weighting.weights &&
         choice.blend.value_or(s.blend) == s.blend;
}

std::string_view reason_against(const PartialChoice& choice) {
  const std::vector<Scheme> all = every_scheme();
  for (const Rule& rule : rules) {
    if (std::ranges::all_of(all, [&](const Scheme& s) { return !fits(choice, s) || breaks(rule, s); }))
      return rule.reason;
  }
  return "each choice contradicts another one";
}

const std::vector<Scheme>& valid_schemes() {
  static const std::vector<Scheme> valid = [] {
    std::vector<Scheme> all = every_scheme();
    std::erase_if(all, [](const Scheme& s) { return conflict(s).has_value(); });
    return all;
  }();
  return valid;
}

std::string text(const Scheme& s) {
  return std::string(entry(s.weighting.elements).name) + ", " + std::string(entry(s.weighting.weights).name) +
         ", " + std::string(entry(s.blend).name) + (s.stitched() ? ", stitched" : "");
}

std::string text_of_percent(double fraction) {
  char text[32];
  const double percent = std::round(1e8 * fraction) / 1e6;  // as it was typed
  return std::string(text, std::to_chars(text, text + sizeof text, percent).ptr) + " %";
}

std::string text_of_reach(double reach) {
  if (!(reach < whole_cage)) return "all";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, reach).ptr};
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
