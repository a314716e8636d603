#include "scene/document/settings.h"

#include <string>

#include "base/error.h"
#include "scene/document/record.h"

namespace viete::scene {

namespace {

// The first ones that have all of these settings; nothing if none have.
std::optional<deform::Weights> weights_with(const deform::AskedWeighting& asked) {
  for (const auto& weights : deform::all_weights()) {
    if (!deform::unused_setting(weights.value, asked)) return weights.value;
  }
  return std::nullopt;
}

}  // namespace

void put_settings(Document& document, const AskedSettings& asked, bool chosen) {
  deform::Scheme scheme = asked.way ? deform::scheme_of(*asked.way, document.scheme) : document.scheme;
  deform::PartialChoice choice = asked.choice;
  if (!chosen && !asked.way && !choice.weights &&
      deform::unused_setting(scheme.weighting.weights, asked.weighting))
    choice.weights = weights_with(asked.weighting);
  if (choice.any()) scheme = deform::complete(choice, scheme);
  scheme.weighting = deform::with(scheme.weighting, asked.weighting);
  if (const auto unused = deform::unused_setting(scheme.weighting.weights, asked.weighting))
    throw base::Error(std::string(unused->option), std::string(unused->reason), std::string(unused->advice));
  if ((asked.turn || asked.stretch) && !deform::entry(scheme.weighting.elements).affine) {
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
  if (const auto reason = deform::conflict(scheme))
    throw base::Error("--stitched", std::string(*reason), "leave it out, or choose other elements");
  if (asked.method) document.put_method(*asked.method);
  document.put_scheme(scheme);
}

}  // namespace viete::scene
