// Deformers: the weights and the blend that deform a model, their names, and how users' choices are combined.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/choice.h"
#include "sym3/exp.h"

namespace viete::pose {

/// The handles of the cage. `face`: the triangles, each with an affine map. `point`: the vertices, which only
/// translate. Weights and blend decide between face and point, see elements_of().
enum class Elements { face, point };
/// Returns "faces" or "vertices".
std::string_view name(Elements elements);

/// The weights of the handles at a vertex. (Smooth weights with bounds, such as bounded biharmonic weights,
/// would need a solver for quadratic programs with 10^5 or more unknowns. Debian 12 has no such package.)
enum class Weights { inverse, cut_off, harmonic, biharmonic, mean_value };
std::span<const base::Choice> choices(Weights);

/// The quantities that are summed with the weights, and how the sums become a position.
enum class Blend { srl, mls_affine, mls_similarity, mls_rigid, linear };
std::span<const base::Choice> choices(Blend);
/// Returns true if the blend fits maps to points, and false if it blends maps of triangles.
bool fits_points(Blend blend);

/// How a frame is computed. `staged`: step by step, in double precision. `fused`: in one pass over the
/// weights, in float. `stitched`: solves for the positions. The program chooses the engine, see engine_for().
enum class EngineKind { staged, fused, stitched };

Elements elements_of(Weights weights, Blend blend);

/// Limit of Deformer::iterations. More iterations change almost nothing.
inline constexpr int most_iterations = 20;

/// All settings that affect the weights of a binding. (The blend does not affect the weights.)
struct Weighting {
  Elements elements = Elements::face;
  Weights weights = Weights::inverse;
  double radius = 0.25;  ///< the radius of cut-off weights, relative to the cage's size
  /// The model has no faces: smooth weights are functions of points in space. Set by bind(), see
  /// weights::weighting_for(). operator== ignores it, because only weightings of one model are compared.
  bool in_space = false;

  double used_radius() const { return partial() ? radius : 0; }
  /// Returns true if weights end at the radius. If so, the weights of a vertex may sum to less than 1, see
  /// Shares.
  bool partial() const { return weights == Weights::cut_off; }
  /// Returns true for harmonic and biharmonic weights.
  bool smooth() const { return weights == Weights::harmonic || weights == Weights::biharmonic; }
  /// Returns true if the weights are functions on the model's surface, and false if of points in space.
  bool on_surface() const { return smooth() && !in_space; }
  /// Returns true if negative weights are set to 0 and the other weights are rescaled to sum 1.
  bool clamped() const { return weights == Weights::biharmonic; }
  /// Returns true if a and b give equal weights.
  friend bool operator==(const Weighting& a, const Weighting& b) {
    return a.elements == b.elements && a.weights == b.weights && a.used_radius() == b.used_radius();
  }
};

/// Factors of the logs of each map. Handles' centres do not change.
struct Amounts {
  double rotation = 1,
         stretch = 1;  ///< rotation: factor of the rotation's log; stretch: of the stretch's log

  bool whole() const { return rotation == 1 && stretch == 1; }
  friend bool operator==(const Amounts&, const Amounts&) = default;
};

/// Additional constraints of a stitched model, see stitch().
struct Holding {
  double radius = 0;  ///< vertices within this distance are attached to the cage; relative to the cage's size
  double weight = 0;  ///< strength of the pull of each vertex towards its blended position

  friend bool operator==(const Holding&, const Holding&) = default;
};

/// The defaults of the members are the published deformer. default_deformer() is the program's default.
struct Deformer {
  Weighting weighting;
  Blend blend = Blend::srl;
  Amounts amounts{};  ///< ignored if elements only translate
  /// Number of solves of a stitched model, see Stitcher. 0: the model is not stitched.
  int iterations = 0;
  Holding holding{};  ///< for stitched models

  bool stitched() const { return iterations > 0; }
  /// Returns true if a frame needs an exponential per vertex.
  bool exponential() const { return blend == Blend::srl; }
  /// Returns true if elements rotate and stretch; false if they only translate.
  bool has_maps() const { return weighting.elements == Elements::face; }
  friend bool operator==(const Deformer& a, const Deformer& b) {
    return a.weighting == b.weighting && a.blend == b.blend && a.amounts == b.amounts &&
           a.iterations == b.iterations && a.holding == b.holding;
  }
};

/// The cheapest deformer, for a cage without elements: see no_cage().
inline Deformer no_motion() {
  return {.weighting = {}, .blend = Blend::linear};
}

/// If weights, blend and stitching are incompatible, returns the reason as a sentence; otherwise nullopt.
std::optional<std::string_view> conflict(const Deformer& deformer);

/// A choice of weights and a choice of a blend. A member without a value allows any value.
struct PartialChoice {
  std::optional<Weights> weights{};
  std::optional<Blend> blend{};

  bool any() const { return weights || blend; }
};
bool fits(const PartialChoice& choice, const Deformer& deformer);

/// Returns all compatible pairs of weights and blend, unstitched and with default numbers.
std::vector<Deformer> valid_deformers();

/// Returns the names of weights and blend, for example "inverse, srl". If stitched, adds ", arap".
std::string text(const Deformer& deformer);

enum class Preset { smooth, paper, mean_value, rigid, arap, local };
std::span<const base::Choice> choices(Preset);

/// Returns the deformer of a preset, with the amounts of `now`.
Deformer deformer_of(Preset preset, const Deformer& now = {});
/// Returns the preset of a deformer, or nullopt. Ignores amounts, radius, number of iterations and holding.
std::optional<Preset> preset_of(const Deformer& deformer);

/// The default is Preset::smooth. It has the lowest energy over the poses of many models and is never among
/// the worst (see the manual).
Deformer default_deformer();

inline PartialChoice only(Weights weights) {
  return {.weights = weights};
}
inline PartialChoice only(Blend blend) {
  return {.blend = blend};
}

/// Returns a deformer with these choices. Keeps as much as possible of `preferred`: the radius, the amounts,
/// and stitching if compatible. Throws base::Error with the reason if the choices are incompatible.
Deformer complete(const PartialChoice& choice, const Deformer& preferred = {});

/// Returns the deformer after a user picks this preset, weights or blend. Keeps compatible choices of
/// `now`.
inline Deformer chosen(Preset preset, const Deformer& now) {
  return deformer_of(preset, now);
}
template <class Choice>
Deformer chosen(Choice choice, const Deformer& now) {
  return complete(only(choice), now);
}

struct AskedDeformer {
  std::optional<Preset> preset{};  ///< the base; the other fields modify it
  PartialChoice choice{};
  std::optional<double> radius{}, rotation{}, stretch{};  ///< see all_numbers()
  bool arap = false;                                      ///< turns ARAP on
  std::optional<int> iterations{};                        ///< needs ARAP, see Deformer::iterations
  std::optional<double> attach{}, hold{};                 ///< see all_numbers()

  bool any() const {
    return preset || choice.any() || radius || rotation || stretch || arap || iterations || attach || hold;
  }
};

/// A setting that is a fraction. Users see and type percent; libraries use the fraction.
struct NumberEntry : base::Choice {
  /// The condition under which a deformer uses the setting, and the error if the condition is not met.
  struct Need {
    bool (*met)(const Deformer& deformer);
    std::string_view problem, advice;
  };
  double& (*of)(Deformer& deformer);
  std::optional<double> AskedDeformer::*asked;
  Need need;
  double least = 0, largest = 1;

  /// The value in percent, rounded to the number that a user typed: 29 instead of 28.999999999999996.
  double percent(Deformer deformer) const;
};
/// Returns a fraction as text, for example "25 %".
std::string text_of_percent(double fraction);
/// The settings "radius", "rotation", "stretch", "attach" and "hold".
std::span<const NumberEntry> all_numbers();
const NumberEntry& number(std::string_view word);

/// Returns `now` with the choices in `asked`. Keeps other choices if they are compatible. `chosen` is true if
/// weights were chosen by name earlier, for example in a session. Otherwise, if `asked` has a radius, but
/// neither a preset nor weights, selects cut-off weights. Throws base::Error for incompatible choices, for
/// numbers that the deformer does not use, and for ARAP with elements that only translate.
Deformer deformer_of(const AskedDeformer& asked, const Deformer& now, bool chosen = false);

/// Returns `stitched` for stitched deformers, `fused` for the method `fast` and for deformers without an
/// exponential, and otherwise `staged`. If `all_staged` is true, treats `fast` like the other methods.
EngineKind engine_for(const Deformer& deformer, sym3::Method method, bool all_staged = false);

}  // namespace viete::pose
