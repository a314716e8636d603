#include "deform/asked_scheme.h"

#include <string>

#include "base/error.h"

namespace viete::deform {

namespace {

// The first ones that have all of these settings; nothing if none have.
std::optional<Weights> weights_with(const AskedWeighting& asked) {
  for (const auto& weights : all_weights()) {
    if (!unused_setting(weights.value, asked)) return weights.value;
  }
  return std::nullopt;
}

}  // namespace

Scheme scheme_of(const AskedScheme& asked, const Scheme& now, bool chosen) {
  Scheme scheme = asked.way ? scheme_of(*asked.way, now) : now;
  PartialChoice choice = asked.choice;
  if (!chosen && !asked.way && !choice.weights &&
      unused_setting(scheme.weighting.weights, asked.weighting))
    choice.weights = weights_with(asked.weighting);
  if (choice.any()) scheme = complete(choice, scheme);
  scheme.weighting = with(scheme.weighting, asked.weighting);
  if (const auto unused = unused_setting(scheme.weighting.weights, asked.weighting))
    throw base::Error(std::string(unused->option), std::string(unused->reason), std::string(unused->advice));
  if ((asked.turn || asked.stretch) && !entry(scheme.weighting.elements).affine) {
    throw base::Error(asked.turn ? "--turn" : "--stretch",
                      "points of the cage only move: they do not turn or stretch",
                      "leave it out, or choose other --elements");
  }
  scheme.amounts.turn = asked.turn.value_or(scheme.amounts.turn);
  scheme.amounts.stretch = asked.stretch.value_or(scheme.amounts.stretch);
  if (asked.iterations) scheme.iterations = *asked.iterations;
  scheme.holding.radius = asked.pins.value_or(scheme.holding.radius);
  scheme.holding.weight = asked.hold.value_or(scheme.holding.weight);
  if ((asked.pins || asked.hold) && !scheme.stitched())
    throw base::Error(asked.pins ? "--pins" : "--hold", "only stitched models are held",
                      "leave it out, or add --stitched");
  if (const auto reason = conflict(scheme))
    throw base::Error("--stitched", std::string(*reason), "leave it out, or choose other elements");
  return scheme;
}

}  // namespace viete::deform
