#include "scene/files/handling_json.h"

#include <nlohmann/json.hpp>

#include "scene/document/range.h"

namespace viete::scene {

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

std::optional<mesh::Point> point_of(const JsonReader& json) {
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
  (void)json.find("");  // what is no object is said once
  take_word(json, "pivot", handling.pivot, warnings);
  take_part(json, "point", handling.point, point_of, "there is none instead", warnings);
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

}  // namespace viete::scene
