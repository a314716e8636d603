#include "scene/files/handling_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scene/document/range.h"

namespace viete::scene {

namespace {

template <class Choice>
void put_word(nlohmann::ordered_json& json, const char* key, Choice value, Choice usual) {
  if (value != usual) json[key] = entry_of(value).word;
}

template <class Choice>
void take_word(const JsonReader& json, const char* key, Choice& value, std::vector<std::string>& warnings) {
  const auto parse = [&](const std::string& word) -> std::optional<Choice> {
    const auto all = choices(value);
    const auto found = std::ranges::find(all, word, &HandChoice::word);
    if (found == all.end()) return std::nullopt;
    return static_cast<Choice>(found - all.begin());
  };
  const std::string instead = "\"" + std::string(entry_of(value).word) + "\" instead";
  take_part(
      json, key, value, [&](const JsonReader& v) { return word_of(v, parse); }, instead.c_str(), warnings);
}

double soft_radius_of(const JsonReader& json) {
  const double percent = json.number();
  if (!(percent >= 100 * SoftSelection::least_radius && percent <= 100 * SoftSelection::largest_radius))
    json.fail("this radius is out of range");
  return percent / 100;
}

std::optional<mesh::Point> point_of(const JsonReader& json) {
  const auto point = json.numbers<3>();
  for (const double x : point) {
    if (!(std::abs(x) <= largest_coordinate)) json.fail("this is too far away");
  }
  return point;
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
  if (handling.mix_selected) json["mix_selected"] = true;
  return json;
}

Handling handling_of(const JsonReader& json, std::vector<std::string>& warnings) {
  Handling handling;
  (void)json.find("");  // what is no object is said once
  take_word(json, "pivot", handling.pivot, warnings);
  take_part(json, "point", handling.point, point_of, "there is none instead", warnings);
  take_word(json, "axes", handling.axes, warnings);
  take_word(json, "mirror", handling.mirror, warnings);
  const auto take_switch = [&](const char* key, bool& on) {
    take_part(
        json, key, on, [](const JsonReader& v) { return v.boolean(); }, "off instead", warnings);
  };
  take_switch("soft", handling.soft.on);
  take_part(json, "radius", handling.soft.radius, soft_radius_of, "35 instead", warnings);
  take_word(json, "curve", handling.soft.curve, warnings);
  take_word(json, "distance", handling.soft.distance, warnings);
  take_switch("mix_selected", handling.mix_selected);
  return handling;
}

}  // namespace viete::scene
