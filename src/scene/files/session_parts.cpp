#include "scene/files/session_parts.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "mesh/formats/text_cursor.h"
#include "scene/document/probes.h"
#include "scene/document/range.h"
#include "scene/files/pose_json.h"

namespace viete::scene {

using nlohmann::ordered_json;

namespace {

template <class Value>
void put_word(nlohmann::ordered_json& json, const char* key, Value value, Value usual) {
  if (value != usual) json[key] = entry_of(value).word;
}

template <class Value>
void take_word(const JsonReader& json, const char* key, Value& value, std::vector<std::string>& warnings) {
  const std::string instead = "\"" + std::string(entry_of(value).word) + "\" instead";
  take_part(json, key, value, choice_of<Value>, instead.c_str(), warnings);
}

double soft_radius_of(const JsonReader& json) {
  using Soft = SoftSelection;
  return json.number(100 * Soft::least_radius, 100 * Soft::largest_radius, "this radius is out of range") /
         100;
}

std::optional<mesh::Point> pivot_of(const JsonReader& json) {
  return json.place(largest_coordinate);
}

}  // namespace

nlohmann::ordered_json handling_json(const Handling& handling) {
  const Handling usual;
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  put_word(json, "pivot", handling.pivot, usual.pivot);
  if (handling.point) json["point"] = *handling.point;
  put_word(json, "axes", handling.axes, usual.axes);
  put_word(json, "mirror", handling.mirror, usual.mirror);
  if (handling.soft.on) json["soft"] = true;
  if (handling.soft.radius != usual.soft.radius) json["radius"] = 100 * handling.soft.radius;
  put_word(json, "curve", handling.soft.curve, usual.soft.curve);
  put_word(json, "distance", handling.soft.distance, usual.soft.distance);
  if (handling.freedom != usual.freedom) json["freedom"] = 100 * handling.freedom;
  if (handling.mix_selected) json["mix_selected"] = true;
  return json;
}

Handling handling_of(const JsonReader& json, std::vector<std::string>& warnings) {
  Handling handling;
  (void)json.find("");  // reports a value that is not an object, once
  take_word(json, "pivot", handling.pivot, warnings);
  take_part(json, "point", handling.point, pivot_of, "there is none instead", warnings);
  take_word(json, "axes", handling.axes, warnings);
  take_word(json, "mirror", handling.mirror, warnings);
  const auto take_switch = [&](const char* key, bool& on) {
    take_part(json, key, on, &JsonReader::boolean, "off instead", warnings);
  };
  take_switch("soft", handling.soft.on);
  take_part(json, "radius", handling.soft.radius, soft_radius_of, "35 instead", warnings);
  take_word(json, "curve", handling.soft.curve, warnings);
  take_word(json, "distance", handling.soft.distance, warnings);
  const auto freedom_of = [](const JsonReader& v) { return v.number(0, 100) / 100; };
  take_part(json, "freedom", handling.freedom, freedom_of, "50 instead", warnings);
  take_switch("mix_selected", handling.mix_selected);
  return handling;
}

namespace {

struct PartKey {
  const char* key;
  Part part;
};
constexpr PartKey part_keys[] = {
    {"turn", &deform::Probe::turn}, {"stretch", &deform::Probe::stretch}, {"move", &deform::Probe::move}};

constexpr std::array pin_words = {"holds", "pulls"};

deform::Pin pin_of(const JsonReader& json) {
  const auto pulls = [](std::string_view word) -> std::optional<bool> {
    if (word == pin_words[0] || word == pin_words[1]) return word == pin_words[1];
    return std::nullopt;
  };
  return {json.at("vertex").index(), word_of(json.at("pin"), pulls)};
}

ordered_json probe_json(const deform::Probe& probe) {
  ordered_json json;
  json["place"] = probe.place;
  for (const auto& [key, part] : part_keys) {
    const deform::Influence& influence = probe.*part;
    json[key] = {{"falloff", deform::entry(influence.falloff).name}, {"radius", influence.radius}};
  }
  if (probe.locked) json["locked"] = true;
  if (probe.pin) json["pin"] = pin_words[probe.pin->pulls], json["vertex"] = probe.pin->vertex;
  put_probe_pose(json, probe.pose);
  return json;
}

deform::Influence influence_of(const JsonReader& json) {
  const auto falloff = [](auto name) { return deform::find_by_name(deform::all_falloffs(), name); };
  const double radius = json.at("radius").number();
  if (!(radius > 0 && radius <= most_drawn)) json.at("radius").fail("the radius must be above 0");
  return {word_of(json.at("falloff"), falloff), radius};
}

deform::Probe probe_of(const JsonReader& json) {
  deform::Probe probe;
  probe.place = json.at("place").place(most_drawn);
  for (const auto& [key, part] : part_keys) probe.*part = influence_of(json.at(key));
  if (const auto v = json.find("locked")) probe.locked = v->boolean();
  if (json.find("pin")) probe.pin = pin_of(json);
  probe.pose = probe_pose_of(json);
  return probe;
}

}  // namespace

ordered_json probes_json(const deform::Probes& probes) {
  ordered_json json = {{"mix", deform::entry(probes.mix).name}, {"all", ordered_json::array()}};
  for (const auto& probe : probes.all) json["all"].push_back(probe_json(probe));
  return json;
}

deform::Probes probes_of(const JsonReader& json, std::vector<std::string>& warnings) {
  deform::Probes probes;
  const auto mix_of = [](const JsonReader& v) {
    return word_of(v, [](auto name) { return deform::find_by_name(deform::all_probe_mixes(), name); });
  };
  take_part(json, "mix", probes.mix, mix_of, "added instead (choices: added, partial, whole, softmax)",
            warnings);
  take_items(json.at("all"), most_probes, "this probe is left out", warnings,
             [&](const JsonReader& item) { probes.all.push_back(probe_of(item)); });
  return probes;
}

namespace {

// Rounded to the number the user typed: 29 instead of 28.999999999999996.
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

// The names of a table as a list for the user.
template <class Entry>
std::string names(std::span<const Entry> table) {
  std::string all;
  for (const Entry& e : table) all += (all.empty() ? "" : ", ") + std::string(e.name);
  return all;
}

}  // namespace

deform::Scheme scheme_of(const JsonReader& json, std::vector<std::string>& warnings) {
  const auto take_choice = [&](const char* key, auto& choice, auto table) {
    const std::string instead = "a matching one instead, one of " + names(table);
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
