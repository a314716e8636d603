#include "scene/files/scheme_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "mesh/formats/text_cursor.h"

namespace viete::scene {

using nlohmann::ordered_json;

namespace {

// As it was typed: 29 and not 28.999999999999996.
double percent(double amount) {
  return std::round(1e8 * amount) / 1e6;
}

double radius_of(const JsonReader& json) {
  const auto radius = deform::radius_from_percent(json.number());
  if (!radius) json.fail("a radius must be 0.1 to 1000 percent of the cage's size");
  return *radius;
}

double amount_of(const JsonReader& json) {
  const auto amount = deform::amount_from_percent(json.number());
  if (!amount) json.fail("an amount must be 0 to 200 percent");
  return *amount;
}

double share_of(const JsonReader& json) {
  const auto share = deform::share_from_percent(json.number());
  if (!share) json.fail("it must be 0 to 100 percent");
  return *share;
}

int iterations_of(const JsonReader& json, deform::Scheme scheme) {
  const std::uint32_t number = json.index();
  if (number < 1 || number > deform::most_iterations)
    json.fail("iterations must be 1 to " + std::to_string(deform::most_iterations));
  scheme.iterations = static_cast<int>(number);
  if (const auto reason = deform::conflict(scheme)) json.fail(std::string(*reason));
  return scheme.iterations;
}

}  // namespace

ordered_json scheme_json(const deform::Scheme& scheme) {
  const deform::Weighting& weighting = scheme.weighting;
  ordered_json json;
  json["weights"] = deform::entry(scheme.weighting.weights).name;
  json["blend"] = deform::entry(scheme.blend).name;
  if (weighting.radius != deform::Weighting{}.radius) json["radius"] = percent(weighting.radius);
  const deform::Amounts& amounts = scheme.amounts;
  if (amounts.turn != 1) json["turn"] = percent(amounts.turn);
  if (amounts.stretch != 1) json["stretch"] = percent(amounts.stretch);
  if (scheme.stitched()) json["stitched"] = scheme.iterations;
  if (scheme.holding.radius > 0) json["pins"] = percent(scheme.holding.radius);
  if (scheme.holding.weight > 0) json["hold"] = percent(scheme.holding.weight);
  return json;
}

namespace {

// Names of a table as people list them.
template <class Entry>
std::string names(std::span<const Entry> table) {
  std::string all;
  for (const Entry& e : table) all += (all.empty() ? "" : ", ") + std::string(e.name);
  return all;
}

}  // namespace

deform::Scheme scheme_of(const JsonReader& json, std::vector<std::string>& warnings) {
  const auto take_choice = [&](const char* key, auto& choice, auto table) {
    const std::string instead = "what fits the others instead, of " + names(table);
    const auto find = [&](auto name) { return deform::find_by_name(table, name); };
    const auto read = [&](const auto& v) { return word_of(v, find); };
    take_part(json, key, choice, read, instead.c_str(), warnings);
  };
  deform::PartialChoice choice;
  take_choice("weights", choice.weights, deform::all_weights());
  take_choice("blend", choice.blend, deform::all_blends());
  std::optional<deform::Scheme> scheme;
  const char* key = choice.blend ? "blend" : choice.weights ? "weights" : nullptr;
  if (key) {
    take_part(
        json, key, scheme,
        [&](const auto& v) {
          try {
            return deform::complete(choice);
          } catch (const base::Error& error) {
            v.fail(error.problem());
          }
        },
        "as published instead", warnings);
  }
  deform::Scheme result = scheme.value_or(deform::Scheme{});
  deform::Weighting& weighting = result.weighting;
  take_part(json, "radius", weighting.radius, radius_of, "25 percent instead", warnings);
  take_part(json, "turn", result.amounts.turn, amount_of, "100 percent instead", warnings);
  take_part(json, "stretch", result.amounts.stretch, amount_of, "100 percent instead", warnings);
  take_part(
      json, "stitched", result.iterations, [&](const auto& v) { return iterations_of(v, result); },
      "not stitched instead", warnings);
  take_part(json, "pins", result.holding.radius, share_of, "0 instead", warnings);
  take_part(json, "hold", result.holding.weight, share_of, "0 instead", warnings);
  return result;
}

}  // namespace viete::scene
