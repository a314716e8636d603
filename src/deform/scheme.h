// How a cage moves a model, as three choices that combine: elements, weights, blend. What there is of each
// stands in one table, from which command line, sessions, panels and tests take names and sentences.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace viete::deform {

/// Which map each handle of the cage carries, and what the handles are.
enum class Elements { face, point };

/// How much of each handle a vertex takes.
enum class Weights { inverse, mean_value };

/// What of the maps is summed, and how the sums become a position.
enum class Blend { srl, linear };

/// Who forms the sums: the links of the chain one by one, in double, or in one pass over the weights, in
/// float. Chosen by the program, see Deformer.
enum class EngineKind { staged, fused };

struct ElementsEntry {
  Elements value;
  std::string_view name;      ///< the word of command line and sessions
  std::string_view sentence;  ///< what it is
  std::string_view handles;   ///< what a person calls them: "faces"
  bool affine;                ///< maps turn and stretch; else they only move, and all blends are the same
};

struct WeightsEntry {
  Weights value;
  std::string_view name, sentence;
  std::string_view reproduces;  ///< which functions of space sums of weights give back exactly
  bool has_reach;               ///< the reach of a Weighting counts
};

struct BlendEntry {
  Blend value;
  std::string_view name, sentence;
  std::string_view reproduces;  ///< which poses of the whole cage the model follows exactly
  std::size_t columns;          ///< numbers that are summed of an affine map
  bool exponential;             ///< a symmetric exponential a vertex and frame; else methods are all the same
};

std::span<const ElementsEntry> all_elements();
std::span<const WeightsEntry> all_weights();
std::span<const BlendEntry> all_blends();
const ElementsEntry& entry(Elements elements);
const WeightsEntry& entry(Weights weights);
const BlendEntry& entry(Blend blend);

/// The value of that name in a table.
template <class Entry>
auto find_by_name(std::span<const Entry> table, std::string_view name)
    -> std::optional<decltype(Entry::value)> {
  for (const Entry& e : table) {
    if (e.name == name) return e.value;
  }
  return std::nullopt;
}

/// A reach without end: every element moves every vertex.
inline constexpr double whole_cage = std::numeric_limits<double>::infinity();
/// Below it next to nothing is blended: a vertex would follow one face here and the next one there, and the
/// model would show the cage's edges.
inline constexpr double lowest_reach = 1.5;

/// What decides the weights of a binding. Which blend they serve does not matter to them.
struct Weighting {
  Elements elements = Elements::face;
  Weights weights = Weights::inverse;
  /// How many times as far as the nearest elements one still has weight, see inverse_distance_weights():
  /// lowest_reach or more. Weights that have no reach leave it unused.
  double reach = whole_cage;

  double used_reach() const { return entry(weights).has_reach ? reach : whole_cage; }
  bool local() const { return used_reach() < whole_cage; }
  /// True if both give the same weights.
  friend bool operator==(const Weighting& a, const Weighting& b) {
    return a.elements == b.elements && a.weights == b.weights && a.used_reach() == b.used_reach();
  }
};

struct Scheme {
  Weighting weighting;
  Blend blend = Blend::srl;

  /// A frame takes an exponential a vertex.
  bool exponential() const { return entry(weighting.elements).affine && entry(blend).exponential; }
  friend bool operator==(const Scheme&, const Scheme&) = default;
};

/// A combination that makes sense.
struct Combination {
  Elements elements;
  Weights weights;
  Blend blend;
  std::string_view shorthand;  ///< the word of --coordinates; empty: it has none
  std::string_view name;       ///< stable, for commands, scripts and tests: "scheme_face"
  std::string_view label;      ///< on buttons: "Faces, log space"
  std::string_view sentence;   ///< what it does

  friend bool operator==(const Scheme& s, const Combination& c) {
    return s.weighting.elements == c.elements && s.weighting.weights == c.weights && s.blend == c.blend;
  }
};
std::span<const Combination> combinations();
/// The row of the table that the scheme is.
const Combination& combination_of(const Scheme& scheme);
const Combination* combination_of_shorthand(std::string_view word);

/// The scheme with other elements, weights and blend.
Scheme with(const Scheme& scheme, const Combination& combination);

/// Choices that are made, and those that are left open.
struct PartialChoice {
  std::optional<Elements> elements{};
  std::optional<Weights> weights{};
  std::optional<Blend> blend{};
};
/// The combination that has all that is chosen, and otherwise most of `preferred`. Throws base::Error if
/// there is none, naming those that there are.
const Combination& complete(const PartialChoice& choice, const Scheme& preferred = {});

/// "3" or "all", as the command line has it.
std::string text_of_reach(double reach);
/// A number from lowest_reach on, or "all".
std::optional<double> reach_from_text(std::string_view text);

}  // namespace viete::deform
