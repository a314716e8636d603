#include "scene/files/camera_json.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/document/range.h"

namespace viete::scene {

using nlohmann::ordered_json;

namespace {

float number_within(const JsonReader& json, double least, double most) {
  const double number = json.number();
  if (!(number >= least && number <= most)) json.fail("this number is out of range");
  return static_cast<float>(number);
}

}  // namespace

double tidy(float value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double shortest = 0;
  std::from_chars(text, end, shortest);
  return static_cast<float>(shortest) == value ? shortest : value;
}

ordered_json camera_json(const CameraPose& c) {
  ordered_json json = {{"target", {tidy(c.target.x), tidy(c.target.y), tidy(c.target.z)}},
                       {"distance", tidy(c.distance)},
                       {"yaw", tidy(c.yaw)},
                       {"pitch", tidy(c.pitch)},
                       {"orthographic", c.orthographic}};
  if (c.up == UpAxis::z) json["up"] = "z";
  return json;
}

CameraPose camera_of(const JsonReader& json, bool turns) {
  CameraPose pose;
  const JsonReader target = json.at("target");
  const auto place = target.numbers<3>();
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(place[i]) <= farthest_place)) target.fail("this is too far away");
    pose.target[i] = static_cast<float>(place[i]);
  }
  pose.distance = number_within(json.at("distance"), nearest_camera, farthest_camera);
  const double yaw = json.at("yaw").number();
  constexpr double whole_turn = 6.283185307179586;
  if (turns && std::abs(yaw) > 1000 * whole_turn) json.at("yaw").fail("these are more than a thousand turns");
  pose.yaw = static_cast<float>(turns || std::abs(yaw) < 4 ? yaw : std::remainder(yaw, whole_turn));
  pose.pitch = number_within(json.at("pitch"), -1.6, 1.6);  // a quarter turn, however it was rounded
  if (const auto v = json.find("orthographic")) pose.orthographic = v->boolean();
  if (const auto v = json.find("up")) {
    const std::string axis = v->text();
    if (axis != "y" && axis != "z") v->fail("the axis that points up is y or z");
    pose.up = axis == "z" ? UpAxis::z : UpAxis::y;
  }
  return pose;
}

}  // namespace viete::scene
