#include "deform/ways.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/error.h"

namespace viete::deform {

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
    WayEntry{{"smooth", "Smooth",
              "spreads along the model's surface, keeps shapes and holds parts together: for most models"},
             Way::smooth,
             scheme(Elements::face, Weights::biharmonic, Blend::srl)},
    WayEntry{{"paper", "As published",
              "as published: each triangle turns and stretches all of the model, by distance"},
             Way::paper,
             scheme(Elements::face, Weights::inverse, Blend::srl)},
    WayEntry{
        {"mean-value", "Mean value",
         "the cage's vertices only move (mean value coordinates): follows affine poses exactly, and caves "
         "in where parts turn"},
        Way::mean_value,
        scheme(Elements::point, Weights::mean_value, Blend::linear)},
    WayEntry{{"rigid", "Rigid",
              "turns without stretching (rigid least squares): keeps details and sizes, also where the cage "
              "grows"},
             Way::rigid,
             scheme(Elements::point, Weights::biharmonic, Blend::mls_rigid)},
    WayEntry{{"arap", "As rigid as possible",
              "solved for all at once (ARAP): details keep their shape best, and frames take longer"},
             Way::arap,
             scheme(Elements::face, Weights::biharmonic, Blend::srl, 1)},
    WayEntry{{"local", "Local", "ends at a radius: what no triangle of the cage reaches stays at rest"},
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
    throw base::Error("", "these weights and this blend do not go together: " + std::string(*reason),
                      "leave one of them out, and it is chosen to fit");
  s.weighting.elements = elements_of(s.weighting.weights, s.blend);
  if (s.has_maps()) s.iterations = preferred.iterations;
  return s;
}

}  // namespace viete::deform
