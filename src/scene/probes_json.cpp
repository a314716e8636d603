#include "scene/probes_json.h"

#include <array>
#include <cmath>

#include "scene/probes.h"
#include "scene/range.h"

namespace viete::scene {

using nlohmann::ordered_json;

namespace {

struct PartKey {
  const char* key;
  Part part;
};
constexpr PartKey part_keys[] = {
    {"turn", &deform::Probe::turn}, {"stretch", &deform::Probe::stretch}, {"move", &deform::Probe::move}};

std::array<double, 6> entries(const sym3::Sym3<double>& s) {
  return {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
}

ordered_json probe_json(const deform::Probe& probe) {
  ordered_json json;
  json["place"] = probe.place;
  for (const auto& [key, part] : part_keys) {
    const deform::Influence& influence = probe.*part;
    json[key] = {{"falloff", deform::entry(influence.falloff).name}, {"radius", influence.radius}};
  }
  if (probe.locked) json["locked"] = true;
  const deform::ProbePose rest, &pose = probe.pose;
  if (pose.turn != rest.turn) json["turned"] = pose.turn;
  if (entries(pose.stretch) != entries(rest.stretch)) json["stretched"] = entries(pose.stretch);
  if (pose.move != rest.move) json["moved"] = pose.move;
  return json;
}

mesh::Point point_of(const JsonReader& json, double limit) {
  const auto point = json.numbers<3>();
  for (const double x : point) {
    if (!(std::abs(x) <= limit)) json.fail("a number is too large");
  }
  return point;
}

deform::Influence influence_of(const JsonReader& json) {
  const auto falloff = [](auto name) { return deform::find_by_name(deform::all_falloffs(), name); };
  const double radius = json.at("radius").number();
  if (!(radius > 0 && radius <= most_drawn)) json.at("radius").fail("a radius must be above 0");
  return {word_of(json.at("falloff"), falloff), radius};
}

sym3::Sym3<double> stretch_of(const JsonReader& json) {
  const auto x = json.numbers<6>();
  const sym3::Sym3<double> stretch{x[0], x[1], x[2], x[3], x[4], x[5]};
  if (!is_probe_stretch(stretch)) json.fail("a number is too large");
  return stretch;
}

deform::Vec3 turn_of(const JsonReader& json) {
  const deform::Vec3 turn = point_of(json, largest_turn);
  if (!(deform::norm(turn) <= largest_turn)) json.fail("a number is too large");
  return turn;
}

deform::Probe probe_of(const JsonReader& json) {
  deform::Probe probe;
  probe.place = point_of(json.at("place"), most_drawn);
  for (const auto& [key, part] : part_keys) probe.*part = influence_of(json.at(key));
  if (const auto v = json.find("locked")) probe.locked = v->boolean();
  if (const auto v = json.find("turned")) probe.pose.turn = turn_of(*v);
  if (const auto v = json.find("stretched")) probe.pose.stretch = stretch_of(*v);
  if (const auto v = json.find("moved")) probe.pose.move = point_of(*v, most_drawn);
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
  take_part(json, "mix", probes.mix, mix_of, "added instead, of added, partial, whole and softmax",
            warnings);
  const JsonReader all = json.at("all");
  if (all.size() > most_probes) all.fail("there are more than " + std::to_string(most_probes) + " probes");
  for (std::size_t i = 0; i < all.size(); ++i) {
    try {
      probes.all.push_back(probe_of(all.item(i)));
    } catch (const base::Error& error) {
      warnings.emplace_back(base::Error(error.place(), error.problem(), "this probe is left out").what());
    }
  }
  return probes;
}

}  // namespace viete::scene
