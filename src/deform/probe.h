// Probes: frames on a model or beside it that move, turn and stretch what is near them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "deform/scheme.h"
#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::deform {

/// How much of a probe's motion a vertex makes, by its distance in radii, at rest.
enum class Falloff { smooth, round, linear, sharp, even, endless, none };

/// How several probes share a vertex.
enum class ProbeMix { added, partial, whole, softmax };

struct FalloffEntry : ChoiceEntry {
  Falloff value;
};
struct ProbeMixEntry : ChoiceEntry {
  ProbeMix value;
};
std::span<const FalloffEntry> all_falloffs();
std::span<const ProbeMixEntry> all_probe_mixes();
const FalloffEntry& entry(Falloff falloff);
const ProbeMixEntry& entry(ProbeMix mix);

/// At a distance of so many radii: 1 at 0, never rising, 0 from 1 on unless it is endless.
double weight_at(Falloff falloff, double radii);

/// Where one part of a probe's motion acts.
struct Influence {
  Falloff falloff = Falloff::smooth;
  double radius = 1;  ///< in the file's unit; above 0

  friend bool operator==(const Influence&, const Influence&) = default;
};

/// What a probe has done since its rest: y = place + exp(Y) exp(X) (x - place) + move. All 0: nothing.
struct ProbePose {
  Vec3 turn{0, 0, 0};            ///< Y as a rotation vector, any number of turns
  sym3::Sym3<double> stretch{};  ///< X = log S
  Vec3 move{0, 0, 0};

  friend bool operator==(const ProbePose& a, const ProbePose& b);
};

/// The same, then turned about the probe's own place by so many radians, however many turns; axis of length
/// 1, not necessarily that of its own turn.
ProbePose turned(const ProbePose& pose, const Vec3& axis, double radians);
/// The same, then scaled along the file's axes. It neither mirrors nor collapses: factors below
/// least_factor become that.
inline constexpr double least_factor = 1e-3;
ProbePose scaled(const ProbePose& pose, const Vec3& factors);
/// exp(Y) exp(X), by rows.
sym3::Mat3<double> linear_part(const ProbePose& pose);

/// A vertex that the shape of the model is brought to where the probe has moved, see ExamplePosing.
struct Pin {
  std::uint32_t vertex;
  bool pulls = false;  ///< towards that place; else it holds there

  friend bool operator==(const Pin&, const Pin&) = default;
};

struct Probe {
  mesh::Point place{0, 0, 0};  ///< at rest
  Influence turn{}, stretch{}, move{};
  bool locked = false;  ///< it holds what it holds, and no hand moves it
  ProbePose pose{};
  std::optional<Pin> pin{};  ///< then it acts upon nothing else; its place is that vertex's

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
  double pivot = 0;  ///< how much its place counts in that about which the vertex turns
};

/// Of all probes at a point, at rest; those of pins are 0. Turn, stretch and move are mixed each by itself:
/// with `partial` they are divided by their sum where that is above 1; with `added` they stay as they are;
/// with `whole` wherever it is above 0; with `softmax` they are e^(b w) - 1, b = softmax_sharpness, over the
/// sum of these, so that the nearest probe has nearly all. Pivots are the larger one of turn and stretch,
/// over their sum. weights.size() == probes.all.size().
inline constexpr double softmax_sharpness = 8;
void probe_weights(const Probes& probes, const mesh::Point& point, std::span<ProbeWeights> weights);

/// Mirrored at the plane where coordinate `axis` (0 x, 1 y, 2 z) is `at`: its place, and what it has done.
Probe mirrored(const Probe& probe, int axis, double at);

}  // namespace viete::deform
