#include "scene/files/probes_json.h"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "scene/document/probes.h"
#include "scene/document/range.h"
#include "scene/files/pose_json.h"

namespace viete::scene {

using nlohmann::ordered_json;

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
  if (!(radius > 0 && radius <= most_drawn)) json.at("radius").fail("a radius must be above 0");
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
  take_part(json, "mix", probes.mix, mix_of, "added instead, of added, partial, whole and softmax", warnings);
  take_items(json.at("all"), most_probes, "this probe is left out", warnings,
             [&](const JsonReader& item) { probes.all.push_back(probe_of(item)); });
  return probes;
}

}  // namespace viete::scene
