// Schemes: weights and a blend that move a model, their names, and how a user's choices become one scheme.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sym3/exp.h"

namespace viete::deform {

/// The parts of the cage that carry maps: its triangles, each with an affine map, or its vertices, which only
/// move. Follows from weights and blend, see elements_of(). Weights and engines call them handles.
enum class Elements { face, point };
/// "faces" or "vertices".
std::string_view name(Elements elements);

/// How much of each handle a vertex takes.
/// (Smooth weights with bounds, as bounded biharmonic ones, take a solver of quadratic programs with bounds
/// of 10^5 and more unknowns; Debian 12 packages none that fits, so there are none.)
enum class Weights { inverse, mean_value, harmonic, biharmonic, cut_off };

/// What of the maps is summed, and how the sums become a position.
enum class Blend { srl, linear, mls_affine, mls_similarity, mls_rigid };

/// Who forms the sums: the links of the chain one by one, in double, or in one pass over the weights, in
/// float; or who solves for positions with them. Chosen by the program, see Deformer.
enum class EngineKind { staged, fused, stitched };

/// What every table says of a choice.
struct ChoiceEntry {
  std::string_view name;      ///< the word of command line and sessions
  std::string_view label;     ///< in the window: "Faces"
  std::string_view sentence;  ///< what it is
};

struct WeightsEntry : ChoiceEntry {
  Weights value;
  bool on_surface = false;  ///< of vertices of the model, along its surface; else of points in space
};

struct BlendEntry : ChoiceEntry {
  Blend value;
  bool of_points = false;  ///< fits maps to points; else it blends those of triangles
};

std::span<const WeightsEntry> all_weights();
std::span<const BlendEntry> all_blends();
const WeightsEntry& entry(Weights weights);
const BlendEntry& entry(Blend blend);

/// The elements of this combination.
Elements elements_of(Weights weights, Blend blend);

/// The value of that name in a table.
template <class Entry>
auto find_by_name(std::span<const Entry> table, std::string_view name)
    -> std::optional<decltype(Entry::value)> {
  for (const Entry& e : table) {
    if (e.name == name) return e.value;
  }
  return std::nullopt;
}

/// Of the cage's size.
inline constexpr double least_radius = 0.001, largest_radius = 10;

/// More change next to nothing.
inline constexpr int most_iterations = 20;

/// What decides the weights of a binding. Which blend they serve does not matter to them.
struct Weighting {
  Elements elements = Elements::face;
  Weights weights = Weights::inverse;
  /// The reach of cut-off weights, in sizes of the cage: least_radius to largest_radius.
  double radius = 0.25;

  double used_radius() const { return partial() ? radius : 0; }
  /// Weights end at the radius, and those of a vertex may sum to less than 1: what is missing stays at rest,
  /// see Shares in binding.h.
  bool partial() const { return weights == Weights::cut_off; }
  /// Weights that the equations make negative become 0, and the others less, so that they sum to 1 again.
  bool clamped() const { return weights == Weights::biharmonic; }
  /// True if both give the same weights.
  friend bool operator==(const Weighting& a, const Weighting& b) {
    return a.elements == b.elements && a.weights == b.weights && a.used_radius() == b.used_radius();
  }
};

/// How much of each map's rotation and of its stretch acts, both in log space: 0 none, 1 as it is, 2 twice
/// as much. Centres follow the cage as they are.
struct Amounts {
  double turn = 1, stretch = 1;

  bool whole() const { return turn == 1 && stretch == 1; }
  friend bool operator==(const Amounts&, const Amounts&) = default;
};
inline constexpr double largest_amount = 2;

/// What holds a stitched model beside the triangles nearest to the cage's handles: see StitchingSettings.
struct Holding {
  double radius = 0;  ///< in sizes of the cage, 0 to largest_pin_radius
  double weight = 0;  ///< of every vertex's blended place, 0 to 1

  friend bool operator==(const Holding&, const Holding&) = default;
};
inline constexpr double largest_pin_radius = 1;

/// The default of members is the published way; that of the program is default_scheme(), see ways.h.
struct Scheme {
  Weighting weighting;
  Blend blend = Blend::srl;
  Amounts amounts{};  ///< of maps that turn and stretch; others leave it unused
  /// How often a stitched model is solved for, see Stitcher; 0: it is not stitched.
  int iterations = 0;
  Holding holding{};  ///< of stitched models

  bool stitched() const { return iterations > 0; }
  /// A frame takes an exponential a vertex.
  bool exponential() const { return blend == Blend::srl; }
  /// Elements turn and stretch; else they only move.
  bool has_maps() const { return weighting.elements == Elements::face; }
  friend bool operator==(const Scheme& a, const Scheme& b) {
    return a.weighting == b.weighting && a.blend == b.blend && a.amounts == b.amounts &&
           a.iterations == b.iterations && a.holding == b.holding;
  }
};

/// What is the least work where a cage has no elements: see no_cage().
inline Scheme no_motion() {
  return {.weighting = {}, .blend = Blend::linear};
}

/// Why weights, blend and stitching do not go together, as a sentence; nothing if they do.
std::optional<std::string_view> conflict(const Scheme& scheme);

/// Choices that are made, and those that are left open.
struct PartialChoice {
  std::optional<Weights> weights{};
  std::optional<Blend> blend{};

  bool any() const { return weights || blend; }
};
/// True if the scheme has all that is chosen.
bool fits(const PartialChoice& choice, const Scheme& scheme);

/// All weights and blends that go together, in the order of the tables; numbers as in a default Weighting,
/// not stitched.
std::vector<Scheme> valid_schemes();

/// "inverse, srl": as the command line names them.
std::string text(const Scheme& scheme);

/// "25 %", of a fraction.
std::string text_of_percent(double fraction);
/// Percent, 0 to 200, as a fraction.
std::optional<double> amount_from_percent(double percent);
/// Percent of the cage's size, as a fraction; nothing if it is no radius.
std::optional<double> radius_from_percent(double percent);
/// Percent, 0 to 100, as a fraction: of the cage's size, of a Holding, or of a whole.
std::optional<double> share_from_percent(double percent);

enum class Way { smooth, paper, mean_value, rigid, arap, local };

struct WayEntry : ChoiceEntry {
  Way value;
  Scheme scheme;
};

std::span<const WayEntry> all_ways();
const WayEntry& entry(Way way);

/// The scheme of a way, with how much turns and stretches act as in `now`.
Scheme scheme_of(Way way, const Scheme& now = {});
/// The way that a scheme is, however much turns and stretches act, wherever weights end that have a radius,
/// and however often and firmly a stitched model is solved for. Nothing if it is none.
std::optional<Way> way_of(const Scheme& scheme);

/// What a model is moved by where nobody chose: Way::smooth, the one whose energy is the lowest over the
/// poses of many models without being high in any (the manual has the table). Weights that do not need a
/// surface where there is none.
Scheme default_scheme(bool has_triangles = true);

inline PartialChoice only(Weights weights) {
  return {.weights = weights};
}
inline PartialChoice only(Blend blend) {
  return {.blend = blend};
}

/// The scheme that has all that is chosen, otherwise as much as possible of `preferred`, its radius, its
/// amounts, and its stitching where that goes with the rest. Throws base::Error if the choices
/// do not go together, saying why.
Scheme complete(const PartialChoice& choice, const Scheme& preferred = {});

/// The scheme after a user picks this way, weights or blend: the other choices of `now` stay where they are
/// compatible with it.
inline Scheme chosen(Way way, const Scheme& now) {
  return scheme_of(way, now);
}
template <class Choice>
Scheme chosen(Choice choice, const Scheme& now) {
  return complete(only(choice), now);
}

struct AskedScheme {
  std::optional<Way> way{};  ///< all of it; what is asked for besides is changed in it
  PartialChoice choice{};
  std::optional<double> radius{};           ///< of cut-off weights
  std::optional<double> turn{}, stretch{};  ///< of Amounts
  std::optional<int> iterations{};          ///< of stitching
  std::optional<double> pins{}, hold{};     ///< of Holding

  bool any() const { return way || choice.any() || radius || turn || stretch || iterations || pins || hold; }
};

/// Choices left open keep their present value where it is compatible with the others. Throws base::Error
/// if choices do not go together, or a radius of weights that have none, or amounts or stitching where
/// elements only move.
///
/// A radius chooses cut-off weights, unless someone has chosen others: by name here, or before (`chosen`), as
/// in a session.
Scheme scheme_of(const AskedScheme& asked, const Scheme& now, bool chosen = false);

/// Stitched schemes have an engine of their own. The fused one knows method `fast` alone, and all that takes
/// no exponential; the staged one runs the others, and `fast` too on the same path as these.
EngineKind engine_for(const Scheme& scheme, sym3::Method method, bool same_path = false);

}  // namespace viete::deform
