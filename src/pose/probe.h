// Probes: points on or near a model that move, rotate and stretch their surroundings.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pose/cage.h"
#include "pose/deformer.h"
#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::pose {

/// How the weight of a probe's motion depends on the rest distance from the probe.
enum class Falloff { smooth, round, linear, sharp, even, endless, none };
std::span<const base::Choice> choices(Falloff);

/// How the weights of several probes at a vertex are combined.
enum class ProbeMix { added, partial, whole, softmax };
std::span<const base::Choice> choices(ProbeMix);

/// Returns the weight, 0 to 1, at a distance in radii. For radii >= 1, only Falloff::endless is above 0.
double weight_at(Falloff falloff, double radii);

/// The range in which one part of a probe's motion (turn, stretch or move) acts.
struct Influence {
  Falloff falloff = Falloff::smooth;
  double radius = 1;  ///< in the file's unit; positive

  friend bool operator==(const Influence&, const Influence&) = default;
};

/// The motion from rest: y = place + exp(Y) * exp(X) * (x - place) + move. At rest, all members are 0.
struct ProbePose {
  Vec3 turn{0, 0, 0};            ///< Y as a rotation vector, any number of turns
  sym3::Sym3<double> stretch{};  ///< X = log S
  Vec3 move{0, 0, 0};

  friend bool operator==(const ProbePose&, const ProbePose&) = default;
};

/// Returns the pose after another rotation about the probe's place, by any angle. The axis must have
/// length 1. It may differ from the axis of the pose's own turn.
ProbePose turned(const ProbePose& pose, const Vec3& axis, double radians);
inline constexpr double least_factor = 1e-3;
/// Returns the pose scaled along the file's axes. Factors below least_factor become least_factor, so that the
/// result neither mirrors nor collapses.
ProbePose scaled(const ProbePose& pose, const Vec3& factors);
/// Returns exp(Y) * exp(X) by rows.
sym3::Mat3<double> linear_part(const ProbePose& pose);

/// A constraint that moves a vertex of the shape to the probe's position, see ExamplePosing.
struct Pin {
  std::uint32_t vertex;
  bool pulls = false;  ///< true: a soft pull towards the position; false: a hard constraint

  friend bool operator==(const Pin&, const Pin&) = default;
};

struct Probe {
  mesh::Point place{0, 0, 0};  ///< at rest
  Influence turn{}, stretch{}, move{};
  bool locked = false;  ///< if true, the probe keeps its effect but cannot be edited
  ProbePose pose{};
  std::optional<Pin> pin{};  ///< if set, the probe is at the pin's vertex and has no other effect

  friend bool operator==(const Probe&, const Probe&) = default;
};

struct Probes {
  std::vector<Probe> all;
  ProbeMix mix = ProbeMix::added;

  bool empty() const { return all.empty(); }
  friend bool operator==(const Probes&, const Probes&) = default;
};

/// The weights of one probe at a vertex.
struct ProbeWeights {
  double turn = 0, stretch = 0, move = 0;
  double pivot = 0;  ///< weight of the probe's place in the point about which the vertex rotates
};

inline constexpr double softmax_sharpness = 8;
/// Computes the weights of all probes at a rest position; pins get 0. `weights` has one entry per probe. The
/// ProbeMix combines weights of turn, stretch and move separately: `added` does not change weights. `partial`
/// divides weights by their sum if the sum is above 1. `whole` always divides them. `softmax` replaces each
/// weight b by e^(softmax_sharpness * b) - 1 and continues as `whole`, so the nearest probe dominates. A
/// probe's `pivot` is its max(turn, stretch), divided by the sum of this maximum over all probes.
void probe_weights(const Probes& probes, const mesh::Point& point, std::span<ProbeWeights> weights);

/// Returns the probe and its motion mirrored at the plane where coordinate `axis` (0 x, 1 y, 2 z) is `at`.
Probe mirrored(const Probe& probe, int axis, double at);

}  // namespace viete::pose
