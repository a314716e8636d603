// Schemes: how a model is deformed (weights and blend), their names, and how a user's choices become one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sym3/exp.h"

namespace viete::deform {

/// The handles of the cage: its triangles, each with an affine map, or its vertices, which only translate.
/// Follows from weights and blend, see elements_of().
enum class Elements { face, point };
/// "faces" or "vertices".
std::string_view name(Elements elements);

/// Weights of the handles at a vertex. (Smooth weights with bounds, such as bounded biharmonic weights, would
/// need a solver for quadratic programs with bounds and 10^5 or more unknowns; Debian 12 packages no suitable
/// one.)
enum class Weights { inverse, mean_value, harmonic, biharmonic, cut_off };

/// The quantities that are summed, and how sums become a position.
enum class Blend { srl, linear, mls_affine, mls_similarity, mls_rigid };

/// How a frame is computed: staged, link by link in double; fused, in one pass over the weights in float; or
/// stitched, by a solve for positions. Chosen by the program, see Deformer.
enum class EngineKind { staged, fused, stitched };

/// The fields common to all tables of choices.
struct ChoiceEntry {
  std::string_view name;      ///< the name in command line and sessions
  std::string_view label;     ///< in the window: "Faces"
  std::string_view sentence;  ///< description
};

struct WeightsEntry : ChoiceEntry {
  Weights value;
  bool on_surface = false;  ///< true: along the model's surface; false: at points in space
};

struct BlendEntry : ChoiceEntry {
  Blend value;
  bool of_points = false;  ///< true: fits maps to points; false: blends maps of triangles
};

std::span<const WeightsEntry> all_weights();
std::span<const BlendEntry> all_blends();
const WeightsEntry& entry(Weights weights);
const BlendEntry& entry(Blend blend);

/// The elements of this combination.
Elements elements_of(Weights weights, Blend blend);

/// The value with this name in a table.
template <class Entry>
auto find_by_name(std::span<const Entry> table, std::string_view name)
    -> std::optional<decltype(Entry::value)> {
  for (const Entry& e : table) {
    if (e.name == name) return e.value;
  }
  return std::nullopt;
}

/// More iterations change almost nothing.
inline constexpr int most_iterations = 20;

/// All settings that the weights of a binding depend on; the blend is not one of them.
struct Weighting {
  Elements elements = Elements::face;
  Weights weights = Weights::inverse;
  double radius = 0.25;  ///< of cut-off weights, in sizes of the cage

  double used_radius() const { return partial() ? radius : 0; }
  /// True if weights end at the radius. The weights of a vertex may then sum to less than 1; the rest of its
  /// share stays at rest, see Shares in binding.h.
  bool partial() const { return weights == Weights::cut_off; }
  /// True if negative weights are set to 0 and the others rescaled to sum 1.
  bool clamped() const { return weights == Weights::biharmonic; }
  /// True if both give the same weights.
  friend bool operator==(const Weighting& a, const Weighting& b) {
    return a.elements == b.elements && a.weights == b.weights && a.used_radius() == b.used_radius();
  }
};

/// Factors of each map's rotation and stretch in log space: 0 none, 1 unchanged, 2 doubled. Centres are not
/// affected.
struct Amounts {
  double turn = 1, stretch = 1;

  bool whole() const { return turn == 1 && stretch == 1; }
  friend bool operator==(const Amounts&, const Amounts&) = default;
};

/// Additional constraints of a stitched model, see stitch().
struct Holding {
  double radius = 0;  ///< in sizes of the cage
  double weight = 0;  ///< pull of every vertex towards its blended position

  friend bool operator==(const Holding&, const Holding&) = default;
};

/// Member defaults are the published scheme; the program's default is default_scheme().
struct Scheme {
  Weighting weighting;
  Blend blend = Blend::srl;
  Amounts amounts{};  ///< for elements with maps; otherwise unused
  /// Number of solves of a stitched model, see Stitcher; 0: not stitched.
  int iterations = 0;
  Holding holding{};  ///< for stitched models

  bool stitched() const { return iterations > 0; }
  /// True if a frame takes an exponential per vertex.
  bool exponential() const { return blend == Blend::srl; }
  /// True if elements rotate and stretch; false if they only translate.
  bool has_maps() const { return weighting.elements == Elements::face; }
  friend bool operator==(const Scheme& a, const Scheme& b) {
    return a.weighting == b.weighting && a.blend == b.blend && a.amounts == b.amounts &&
           a.iterations == b.iterations && a.holding == b.holding;
  }
};

/// The cheapest scheme, for a cage without elements: see no_cage().
inline Scheme no_motion() {
  return {.weighting = {}, .blend = Blend::linear};
}

/// Why weights, blend and stitching are incompatible, as a sentence; nullopt if they are compatible.
std::optional<std::string_view> conflict(const Scheme& scheme);

/// A choice of weights, blend, both or neither; an empty member allows any value.
struct PartialChoice {
  std::optional<Weights> weights{};
  std::optional<Blend> blend{};

  bool any() const { return weights || blend; }
};
/// True if the scheme agrees with the choice.
bool fits(const PartialChoice& choice, const Scheme& scheme);

/// All compatible pairs of weights and blend, in the order of the tables; numbers as in a default Weighting,
/// not stitched.
std::vector<Scheme> valid_schemes();

/// "inverse, srl": as the command line names them.
std::string text(const Scheme& scheme);

enum class Way { smooth, paper, mean_value, rigid, arap, local };

struct WayEntry : ChoiceEntry {
  Way value;
  Scheme scheme;
};

std::span<const WayEntry> all_ways();
const WayEntry& entry(Way way);

/// The scheme of a deformer, with the amounts of `now`.
Scheme scheme_of(Way way, const Scheme& now = {});
/// The deformer of a scheme, for any amounts, radius, iterations and holding. Nullopt if none matches.
std::optional<Way> way_of(const Scheme& scheme);

/// The default deformer: Way::smooth, which has the lowest energy over the poses of many models and is never
/// among the worst (the manual has the table). Models without triangles get weights that need no surface.
Scheme default_scheme(bool has_triangles = true);

inline PartialChoice only(Weights weights) {
  return {.weights = weights};
}
inline PartialChoice only(Blend blend) {
  return {.blend = blend};
}

/// The scheme that agrees with all choices and takes as much as possible of `preferred`: its radius, its
/// amounts, and its stitching if compatible. Throws base::Error with the reason if the choices are
/// incompatible.
Scheme complete(const PartialChoice& choice, const Scheme& preferred = {});

/// The scheme after a user picks this deformer, weights or blend; keeps the other choices of `now` if
/// compatible.
inline Scheme chosen(Way way, const Scheme& now) {
  return scheme_of(way, now);
}
template <class Choice>
Scheme chosen(Choice choice, const Scheme& now) {
  return complete(only(choice), now);
}

struct AskedScheme {
  std::optional<Way> way{};  ///< the base; the other fields modify it
  PartialChoice choice{};
  std::optional<double> radius{}, turn{}, stretch{};  ///< see all_numbers()
  std::optional<int> iterations{};                    ///< for stitching
  std::optional<double> pins{}, hold{};               ///< see all_numbers()

  bool any() const { return way || choice.any() || radius || turn || stretch || iterations || pins || hold; }
};

/// A setting that is a fraction. People see and type it in percent, libraries as it is.
struct NumberEntry : ChoiceEntry {
  /// The condition for a scheme to use it, and the error otherwise.
  struct Need {
    bool (*met)(const Scheme& scheme);
    std::string_view problem, advice;
  };
  double& (*of)(Scheme& scheme);
  std::optional<double> AskedScheme::*asked;
  Need need;
  double least = 0, largest = 1;

  /// Percent, rounded to the number a user typed: 29 instead of 28.999999999999996.
  double percent(Scheme scheme) const;
};
/// A fraction as "25 %".
std::string text_of_percent(double fraction);
/// "radius", "turn", "stretch", "pins" and "hold".
std::span<const NumberEntry> all_numbers();
const NumberEntry& number(std::string_view name);

/// Open choices keep their value of `now` if compatible with the others. Throws base::Error for incompatible
/// choices, for numbers that the scheme does not use, and for stitching of elements that only translate.
///
/// A radius selects cut-off weights, unless other weights were chosen explicitly: by name here, or earlier
/// (`chosen`), for example in a session.
Scheme scheme_of(const AskedScheme& asked, const Scheme& now, bool chosen = false);

/// Stitched schemes use the stitched engine. The fused engine runs method `fast` and schemes without an
/// exponential; the staged engine runs all other methods, and `fast` too if `same_path`.
EngineKind engine_for(const Scheme& scheme, sym3::Method method, bool same_path = false);

}  // namespace viete::deform
