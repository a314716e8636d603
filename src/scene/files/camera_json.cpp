#include "scene/files/camera_json.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/document/range.h"

namespace viete::scene {

using nlohmann::ordered_json;

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
  const auto target = json.at("target").place(farthest_place);
  pose.target = {target[0], target[1], target[2]};
  pose.distance = static_cast<float>(json.at("distance").number(nearest_camera, farthest_camera));
  const double yaw = json.at("yaw").number();
  constexpr double whole_turn = 6.283185307179586;
  if (turns && std::abs(yaw) > 1000 * whole_turn) json.at("yaw").fail("this is more than a thousand turns");
  pose.yaw = static_cast<float>(turns || std::abs(yaw) < 4 ? yaw : std::remainder(yaw, whole_turn));
  // A quarter turn, with any rounding.
  pose.pitch = static_cast<float>(json.at("pitch").number(-1.6, 1.6));
  if (const auto v = json.find("orthographic")) pose.orthographic = v->boolean();
  if (const auto v = json.find("up")) {
    const std::string axis = v->text();
    if (axis != "y" && axis != "z") v->fail("the up axis must be y or z");
    pose.up = axis == "z" ? UpAxis::z : UpAxis::y;
  }
  return pose;
}

}  // namespace viete::scene
