#include "pose/probe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pose/branches.h"
#include "pose/maps.h"
#include "sym3/exp.h"

namespace viete::pose {

namespace {

constexpr base::Choice falloffs[] = {
    {"smooth", "Smooth", "Decreases smoothly to zero at the radius"},
    {"round", "Round", "Strong almost up to the radius, then decreases to zero"},
    {"linear", "Linear", "Decreases linearly to zero at the radius"},
    {"sharp", "Sharp", "Strong only close to the probe, zero at the radius"},
    {"even", "Even", "Constant up to the radius, zero beyond it"},
    {"endless", "Endless", "Acts at every distance, with half strength at the radius"},
    {"none", "Off", "No influence"},
};

constexpr base::Choice mixes[] = {
    {"added", "Added", "Adds the effects of all probes. Two probes moved together act twice as strongly"},
    {"partial", "Divided",
     "Scales the weights down where their sum exceeds 1, so two probes moved together act like one"},
    {"whole", "Whole",
     "Scales the weights to a sum of 1 near any probe. Probes at rest keep their surroundings at rest"},
    {"softmax", "Nearest", "The nearest probe has most of the effect (softmax of the weights)"},
};

constexpr std::array parts = {&ProbeWeights::turn, &ProbeWeights::stretch, &ProbeWeights::move};

// Divides the member `part` of each weight by the sum of this member. If not `always`, skips sums up to 1.
void share_out(std::span<ProbeWeights> weights, double ProbeWeights::*part, bool always) {
  double sum = 0;
  for (const auto& w : weights) sum += w.*part;
  if (!(sum > (always ? 0 : 1))) return;
  for (auto& w : weights) w.*part /= sum;
}

}  // namespace

std::span<const base::Choice> choices(Falloff) {
  return falloffs;
}
std::span<const base::Choice> choices(ProbeMix) {
  return mixes;
}

double weight_at(Falloff falloff, double t) {
  const double left = std::max(0.0, 1 - t);
  switch (falloff) {
    case Falloff::smooth: return left * left * (1 + 2 * std::min(t, 1.0));
    case Falloff::round: return std::sqrt(left * (1 + std::min(t, 1.0)));
    case Falloff::linear: return left;
    case Falloff::sharp: return left * left;
    case Falloff::even: return left > 0 ? 1 : 0;
    case Falloff::endless: return 1 / (1 + t * t);
    case Falloff::none: break;
  }
  return 0;
}

sym3::Mat3<double> linear_part(const ProbePose& pose) {
  return times(sym3::exp_rotation(pose.turn), full(sym3::exp(pose.stretch)));
}

// Rotates in small steps, so that the log continues on the right branch for large angles.
ProbePose turned(const ProbePose& pose, const Vec3& axis, double radians) {
  constexpr double largest_step = 1.5;
  ProbePose result = pose;
  const auto from = sym3::exp_rotation(pose.turn);
  const auto steps = static_cast<int>(std::ceil(std::abs(radians) / largest_step));
  for (int i = 1; i <= steps; ++i) {
    const auto now = times(sym3::exp_rotation((radians * i / steps) * axis), from);
    result.turn = nearest_branch(sym3::log_rotation(now), result.turn);
  }
  return result;
}

ProbePose scaled(const ProbePose& pose, const Vec3& factors) {
  sym3::Mat3<double> m = linear_part(pose);
  for (std::size_t i = 0; i < 9; ++i) m[i] *= std::max(factors[i / 3], least_factor);
  Polar split = polar(m);
  for (double& s : split.stretches) s = std::clamp(s, 1e-6, 1e6);
  ProbePose result = pose;
  result.turn = nearest_branch(sym3::log_rotation(split.rotation), pose.turn);
  result.stretch = log_stretch(split);
  return result;
}

void probe_weights(const Probes& probes, const mesh::Point& point, std::span<ProbeWeights> weights) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Probe& probe = probes.all[i];
    weights[i] = {};
    if (probe.pin) continue;
    const double distance = norm(point - probe.place);
    const auto at = [&](const Influence& part) { return weight_at(part.falloff, distance / part.radius); };
    weights[i] = {at(probe.turn), at(probe.stretch), at(probe.move), 0};
  }
  for (const auto part : parts) {
    if (probes.mix == ProbeMix::softmax) {
      for (auto& w : weights) w.*part = std::expm1(softmax_sharpness * w.*part);
    }
    if (probes.mix != ProbeMix::added) share_out(weights, part, probes.mix != ProbeMix::partial);
  }
  for (auto& w : weights) w.pivot = std::max(w.turn, w.stretch);
  share_out(weights, &ProbeWeights::pivot, true);
}

// With a reflection F, the rotation R becomes F * R * F. This reflects the axis and reverses the rotation.
Probe mirrored(const Probe& probe, int axis, double at) {
  const auto a = static_cast<std::size_t>(axis);
  Probe result = probe;
  result.place[a] = 2 * at - probe.place[a];
  result.pose.move[a] = -probe.pose.move[a];
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != a) result.pose.turn[i] = -probe.pose.turn[i];
  }
  auto& x = result.pose.stretch;
  if (a != 2) x.xy = -x.xy;
  if (a != 1) x.xz = -x.xz;
  if (a != 0) x.yz = -x.yz;
  return result;
}

}  // namespace viete::pose
