// How a cage moves a model, as three choices that combine: elements, weights, blend. What there is of each
// stands in one table, from which command line, sessions, panels and tests take names and sentences; what
// does not go together is said by conflict(). Six of the combinations have names: see ways.h.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viete::deform {

// Saved bindings hold numbers of these: new ones come last.

/// Which map each handle of the cage carries, and what the handles are.
enum class Elements { face, point, patch, vertex_patch, edge, vertex, vertex_face, polygon };

/// How much of each handle a vertex takes.
/// (Smooth weights with bounds, as bounded biharmonic ones, take a solver of quadratic programs with bounds
/// of 10^5 and more unknowns; Debian 12 packages none that fits, so there are none.)
enum class Weights { inverse, mean_value, integrated, harmonic, biharmonic, cut_off };

/// What of the maps is summed, and how the sums become a position.
enum class Blend { srl, linear, slrl, sql, log3, sse, log4, mls_affine, mls_similarity, mls_rigid };

/// What of the cage handles are: its triangles, each about its own centre or about that of its polygon, which
/// all triangles of this share; edges; or vertices.
enum class Handles { faces, polygon_faces, edges, vertices };
/// True if they are triangles.
constexpr bool of_triangles(Handles handles) {
  return handles == Handles::faces || handles == Handles::polygon_faces;
}
std::string_view name(Handles handles);

/// Who forms the sums: the links of the chain one by one, in double, or in one pass over the weights, in
/// float; or who solves for positions with them. Chosen by the program, see Deformer.
enum class EngineKind { staged, fused, stitched };

/// What every table says of a choice.
struct ChoiceEntry {
  std::string_view name;      ///< the word of command line and sessions
  std::string_view label;     ///< in the window: "Faces"
  std::string_view sentence;  ///< what it is
};

struct ElementsEntry : ChoiceEntry {
  Elements value;
  Handles handles;
  bool affine;                  ///< maps turn and stretch; else they only move, and all blends are the same
  std::string_view reproduces;  ///< which poses of the whole cage each map follows exactly
};

/// Which settings of a Weighting count.
struct WeightSettings {
  bool reach = false, radius = false, exponent = false, clamp = false, normalise = false;
};

struct WeightsEntry : ChoiceEntry {
  Weights value;
  std::string_view reproduces;  ///< which functions of space sums of weights give back exactly
  WeightSettings has{};
  bool on_surface = false;  ///< of vertices of the model, along its surface; else of points in space
};

struct BlendEntry : ChoiceEntry {
  Blend value;
  bool exponential;        ///< a symmetric exponential a vertex and frame; else methods are all the same
  bool about_center;       ///< what is blended turns and stretches a vertex about the blended centre alone
  bool of_points = false;  ///< fits maps to points; else it blends those that elements have
};

std::span<const ElementsEntry> all_elements();
std::span<const WeightsEntry> all_weights();
std::span<const BlendEntry> all_blends();
const ElementsEntry& entry(Elements elements);
const WeightsEntry& entry(Weights weights);
const BlendEntry& entry(Blend blend);

/// The first elements that have the same handles and weights: of patches, faces.
Elements weighed_as(Elements elements);

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

/// Of the cage's size.
inline constexpr double least_radius = 0.001, largest_radius = 10;
inline constexpr int most_exponent = 8;

/// More change next to nothing.
inline constexpr int most_iterations = 20;

/// What decides the weights of a binding. Which blend they serve does not matter to them.
struct Weighting {
  Elements elements = Elements::face;
  Weights weights = Weights::inverse;
  /// How many times as far as the nearest elements one still has weight, see inverse_distance_weights():
  /// lowest_reach or more. Weights that have no reach leave it unused.
  double reach = whole_cage;

  /// Where cut-off weights end, in sizes of the cage (see size_of()): least_radius to largest_radius.
  double radius = 0.25;
  /// Of distances, 1 to most_exponent: the higher, the more local.
  int exponent = 2;
  /// Weights below 0 become 0, and the others less, so that they sum to 1 again.
  bool clamp = true;
  /// Weights always sum to 1, also where few elements reach: see cut_off_weights().
  bool normalise = false;
  /// By the rules before version 0.3, for sessions and bindings of then: parts of a model are weighed each by
  /// itself, along its surface alone, so that they come apart; and the size of a cage is the diagonal of its
  /// bounds, which is another one when cage and model are turned together.
  bool as_before = false;

  double used_reach() const { return entry(weights).has.reach ? reach : whole_cage; }
  double used_radius() const { return entry(weights).has.radius ? radius : 0; }
  int used_exponent() const { return entry(weights).has.exponent ? exponent : 0; }
  bool used_clamp() const { return entry(weights).has.clamp && clamp; }
  bool used_normalise() const { return entry(weights).has.normalise && normalise; }
  bool used_as_before() const { return changed_in_03() && as_before; }
  bool changed_in_03() const { return entry(weights).on_surface || entry(weights).has.radius; }
  /// Elements that are far away have no weight at all.
  bool local() const { return used_reach() < whole_cage || entry(weights).has.radius; }
  /// Weights of a vertex may sum to less than 1: what is missing stays at rest, see Shares in binding.h.
  bool partial() const { return entry(weights).has.radius; }
  /// True if both give the same weights, whatever maps they are for.
  friend bool operator==(const Weighting& a, const Weighting& b) {
    return weighed_as(a.elements) == weighed_as(b.elements) && a.weights == b.weights && a.same_numbers(b);
  }
  bool same_numbers(const Weighting& other) const;
};

/// Those settings of weights that someone has asked for.
struct AskedWeighting {
  std::optional<double> reach{}, radius{};
  std::optional<int> exponent{};
  std::optional<bool> clamp{};
  bool normalise = false;

  bool any() const { return reach || radius || exponent || clamp || normalise; }
};
/// With these settings, whether its weights have them or not.
Weighting with(Weighting weighting, const AskedWeighting& asked);
/// The option of the first of these that weights do not have, and why; nothing if they have all.
struct UnusedSetting {
  std::string_view option, reason, advice;
};
std::optional<UnusedSetting> unused_setting(Weights weights, const AskedWeighting& asked);

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
  /// Weighting::as_before makes a difference.
  bool changed_in_03() const;
  /// A frame takes an exponential a vertex.
  bool exponential() const { return entry(weighting.elements).affine && entry(blend).exponential; }
  friend bool operator==(const Scheme& a, const Scheme& b) {
    return a.weighting.elements == b.weighting.elements && a.weighting == b.weighting && a.blend == b.blend &&
           a.amounts == b.amounts && a.iterations == b.iterations && a.holding == b.holding &&
           (!a.changed_in_03() || a.weighting.as_before == b.weighting.as_before);
  }
};

/// What is the least work where a cage has no elements: see no_cage().
inline Scheme no_motion() {
  return {.weighting = {}, .blend = Blend::linear};
}

/// Why these do not go together, as a sentence; nothing if they do.
std::optional<std::string_view> conflict(const Scheme& scheme);

/// Choices that are made, and those that are left open.
struct PartialChoice {
  std::optional<Elements> elements{};
  std::optional<Weights> weights{};
  std::optional<Blend> blend{};

  bool any() const { return elements || weights || blend; }
};
/// The rule that all combinations with these choices break, as a sentence.
std::string_view reason_against(const PartialChoice& choice);
/// True if the scheme has all that is chosen.
bool fits(const PartialChoice& choice, const Scheme& scheme);

/// All elements, weights and blends that go together, in the order of the tables; numbers as in a default
/// Weighting, not stitched.
const std::vector<Scheme>& valid_schemes();

/// "face, inverse, srl": as the command line names them.
std::string text(const Scheme& scheme);

/// "25 %", of a fraction.
std::string text_of_percent(double fraction);
/// "3" or "all", as the command line has it.
std::string text_of_reach(double reach);
/// Percent, 0 to 200, as a fraction.
std::optional<double> amount_from_percent(double percent);
/// Percent of the cage's size, as a fraction; nothing if it is no radius.
std::optional<double> radius_from_percent(double percent);
/// Percent, 0 to 100, as a fraction: of the cage's size, of a Holding, or of a whole.
std::optional<double> share_from_percent(double percent);
/// A number from lowest_reach on, or "all".
std::optional<double> reach_from_text(std::string_view text);

}  // namespace viete::deform
