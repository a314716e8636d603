#include "deform/asked_scheme.h"

#include <string>

#include "base/error.h"

namespace viete::deform {

Scheme scheme_of(const AskedScheme& asked, const Scheme& now, bool chosen) {
  Scheme scheme = asked.way ? scheme_of(*asked.way, now) : now;
  PartialChoice choice = asked.choice;
  if (asked.radius && !chosen && !asked.way && !choice.weights) choice.weights = Weights::cut_off;
  if (choice.any()) scheme = complete(choice, scheme);
  scheme.weighting.radius = asked.radius.value_or(scheme.weighting.radius);
  if (asked.radius && !scheme.weighting.partial())
    throw base::Error("--radius", "these weights have no radius", "leave it out, or choose --weights cutoff");
  if ((asked.turn || asked.stretch) && !scheme.has_maps()) {
    throw base::Error(asked.turn ? "--turn" : "--stretch",
                      "points of the cage only move: they do not turn or stretch",
                      "leave it out, or choose another way or blend");
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
    throw base::Error("--stitched", std::string(*reason), "leave it out, or choose another way or blend");
  return scheme;
}

}  // namespace viete::deform
