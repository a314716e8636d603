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

// Beside what is one choice away from a way with a name.
constexpr std::array offered_besides = {
    // Schaefer, McPhail and Warren, Image deformation using moving least squares, 2006, in space.
    scheme(Elements::point, Weights::inverse, Blend::mls_affine),
    scheme(Elements::point, Weights::inverse, Blend::mls_similarity),
    // Of those that follow affine poses exactly, the one that distorts least without a surface.
    scheme(Elements::vertex_patch, Weights::mean_value, Blend::sse),
};

struct OldWord {
  std::string_view word;
  Way way;
};
constexpr std::array old_words = {OldWord{"face", Way::paper}, OldWord{"mvc", Way::mean_value}};

int in_common(const Scheme& a, const Scheme& b) {
  return (a.weighting.elements == b.weighting.elements) + (a.weighting.weights == b.weighting.weights) +
         (a.blend == b.blend);
}
bool same_choices(const Scheme& a, const Scheme& b) {
  return in_common(a, b) == 3;
}

bool is_offered(const Scheme& s) {
  const auto is_near = [&](const WayEntry& way) { return in_common(s, way.scheme) >= 2; };
  const auto is_this = [&](const Scheme& other) { return same_choices(s, other); };
  return std::ranges::any_of(ways_table, is_near) || std::ranges::any_of(offered_besides, is_this);
}

// The published ways come first where several serve someone as well.
int rank(const Scheme& s) {
  return old_word(s).empty() ? 0 : 1;
}

// How well a scheme serves who prefers the other one. `point` alone stays what it was before maps were fitted
// to points.
int likeness(const Scheme& s, const Scheme& preferred) {
  const bool unasked = entry(s.blend).of_points && !entry(preferred.blend).of_points;
  return 2 * (in_common(s, preferred) - (unasked ? 3 : 0)) + rank(s);
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
  Weighting usual{s.weighting.elements, s.weighting.weights};
  usual.radius = s.weighting.radius;
  const bool as_before = s.changed_in_03() && s.weighting.as_before;
  if (as_before || !s.weighting.same_numbers(usual)) return std::nullopt;
  const auto is_it = [&](const WayEntry& way) {
    return same_choices(s, way.scheme) && s.stitched() == way.scheme.stitched();
  };
  const auto found = std::ranges::find_if(ways_table, is_it);
  return found == ways_table.end() ? std::nullopt : std::optional(found->value);
}

std::string_view old_word(const Scheme& s) {
  const auto found = std::ranges::find_if(
      old_words, [&](const OldWord& old) { return same_choices(s, entry(old.way).scheme); });
  return found == old_words.end() ? std::string_view{} : found->word;
}

std::optional<Way> way_of_old_word(std::string_view word) {
  const auto found = std::ranges::find(old_words, word, &OldWord::word);
  return found == old_words.end() ? std::nullopt : std::optional(found->way);
}

Scheme default_scheme(bool has_triangles) {
  return entry(has_triangles ? Way::smooth : Way::paper).scheme;
}

const std::vector<Scheme>& offered_schemes() {
  static const std::vector<Scheme> offered = [] {
    std::vector<Scheme> all = valid_schemes();
    std::erase_if(all, [](const Scheme& s) { return !is_offered(s); });
    return all;
  }();
  return offered;
}

Scheme complete(const PartialChoice& choice, const Scheme& preferred, const std::vector<Scheme>& among) {
  const Scheme* best = nullptr;
  for (const Scheme& s : among) {
    if (fits(choice, s) && (!best || likeness(s, preferred) > likeness(*best, preferred))) best = &s;
  }
  if (!best) {
    throw base::Error(
        "", "these elements, weights and blend do not go together: " + std::string(reason_against(choice)),
        "leave one of them out, and it is chosen to fit");
  }
  Scheme result = preferred;
  result.weighting.elements = best->weighting.elements;
  result.weighting.weights = best->weighting.weights;
  result.blend = best->blend;
  if (conflict(result)) result.iterations = 0;
  return result;
}

}  // namespace viete::deform
