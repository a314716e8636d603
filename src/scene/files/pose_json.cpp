#include "scene/files/pose_json.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "base/encoding.h"
#include "base/error.h"
#include "scene/document/pose_edit.h"
#include "scene/document/probes.h"
#include "scene/document/range.h"
#include "scene/document/time_edit.h"
#include "scene/files/camera_json.h"

namespace viete::scene {

using nlohmann::ordered_json;

namespace {

struct Points {
  std::vector<mesh::Point> all;
  std::vector<std::size_t> unread;
};

Points points_of(const JsonReader& json, double limit, double otherwise) {
  Points points{std::vector<mesh::Point>(json.size(), {otherwise, otherwise, otherwise}), {}};
  for (std::size_t i = 0; i < points.all.size(); ++i) {
    if (const auto point = json.point(i, limit)) {
      points.all[i] = *point;
    } else {
      points.unread.push_back(i);
    }
  }
  return points;
}

// "vertex 5 is at rest instead".
void warn_of_unread(const JsonReader& json, const std::vector<std::size_t>& unread,
                    const std::string& element, const std::string& instead,
                    std::vector<std::string>& warnings) {
  if (unread.empty()) return;
  const bool one = unread.size() == 1;
  const std::string others = one ? "" : " and " + std::to_string(unread.size() - 1) + " more";
  try {
    json.item(unread.front()).numbers<3>();
    json.item(unread.front()).fail("a number is too large");
  } catch (const base::Error& error) {
    warnings.emplace_back(base::Error(error.place(), error.problem(),
                                      element + ' ' + std::to_string(unread.front()) + others +
                                          (one ? " is " : " are ") + instead)
                              .what());
  }
}

std::array<double, 6> six(const sym3::Sym3<double>& s) {
  return {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
}

mesh::Vec3 short_vector(const JsonReader& json, double longest) {
  const mesh::Vec3 vector = json.numbers<3>();
  if (!(mesh::norm(vector) <= longest)) json.fail("a number is too large");
  return vector;
}

sym3::Sym3<double> probe_stretch_of(const JsonReader& json) {
  const auto x = json.numbers<6>();
  const sym3::Sym3<double> stretch{x[0], x[1], x[2], x[3], x[4], x[5]};
  if (!is_probe_stretch(stretch)) json.fail("a number is too large");
  return stretch;
}

double frame_number(const JsonReader& json) {
  return json.number(Timeline::least_frame, Timeline::largest_frame);
}

int frame_of(const JsonReader& json) {
  return static_cast<int>(std::lround(frame_number(json)));
}

// As typed, if that reads back as the same weight.
double percent_of(double weight) {
  const double typed = std::round(1e8 * weight) / 1e6;
  return typed / 100 == weight ? typed : 100 * weight;
}

double weight_of(const JsonReader& json) {
  return json.number(100 * PoseLibrary::least_weight, 100 * PoseLibrary::largest_weight) / 100;
}

std::vector<MixedPose> mix_of(const JsonReader& json) {
  std::vector<MixedPose> mix;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const JsonReader item = json.item(i);
    mix.push_back({item.at("name").text(), weight_of(item.at("weight"))});
  }
  return mix;
}

NamedPose named_pose_of(const JsonReader& json, std::span<const SharedShape> shapes,
                        std::vector<std::string>& warnings) {
  NamedPose named{json.at("name").text(), whole_pose_of(json, shapes, warnings)};
  if (named.name.size() > PoseLibrary::longest_name) json.at("name").fail("this name is too long");
  take_part(json, "weight", named.weight, weight_of, "it counts as edited directly", warnings);
  const std::size_t told = warnings.size();
  take_part(json, "part", named.part, &JsonReader::indices, "it counts as edited directly", warnings);
  if (warnings.size() > told) named.weight = 0;
  return named;
}

PoseKey key_of(const JsonReader& json, std::span<const SharedShape> shapes,
               std::vector<std::string>& warnings) {
  PoseKey key{frame_of(json.at("frame")), whole_pose_of(json, shapes, warnings)};
  take_part(json, "easing", key.easing, choice_of<Easing>, "smooth instead", warnings);
  take_part(json, "mix", key.mix, mix_of, "it counts as edited directly", warnings);
  return key;
}

std::vector<PoseKey> keys_of(const JsonReader& json, std::span<const SharedShape> shapes,
                             std::vector<std::string>& warnings) {
  std::vector<PoseKey> keys;
  take_items(json, Timeline::most_keys, "it is left out", warnings,
             [&](const JsonReader& item) { keys.push_back(key_of(item, shapes, warnings)); });
  return keys;
}

std::vector<CameraKey> cameras_of(const JsonReader& json, std::vector<std::string>& warnings) {
  std::vector<CameraKey> keys;
  take_items(json, Timeline::most_keys, "this camera key is left out", warnings, [&](const JsonReader& item) {
    keys.push_back({frame_of(item.at("frame")), camera_of(item, true)});
  });
  return keys;
}

// Sorts by frame; of equal frames the first one is kept.
template <class Keys>
void put_in_order(Keys& keys) {
  const auto frame = [](const auto& key) { return key.frame; };
  std::ranges::stable_sort(keys, {}, frame);
  keys.erase(std::ranges::unique(keys, {}, frame).begin(), keys.end());
}

bool fits(const WholePose& pose, const deform::Cage* cage, const mesh::Surface& model) {
  return (!pose.shape || pose.shape->size() == model.positions.size()) &&
         pose.cage.positions.size() == (cage ? cage->surface.positions.size() : 0) &&
         pose.cage.turns.size() <= (cage ? cage->roots.size() : 0);
}

void rest_unread(SharedPose& pose, const deform::Cage& cage) {
  const auto unread = [](const mesh::Point& p) { return std::isnan(p[0]); };
  if (std::ranges::none_of(pose->cage.positions, unread)) return;
  WholePose whole = *pose;
  for (std::size_t v = 0; v < whole.cage.positions.size(); ++v)
    if (unread(whole.cage.positions[v])) whole.cage.positions[v] = cage.surface.positions[v];
  pose = std::make_shared<const WholePose>(std::move(whole));
}

}  // namespace

ordered_json pose_json(const deform::Pose& pose) {
  return {{"turns", pose.turns}, {"positions", pose.positions}};
}

deform::Pose pose_of(const JsonReader& json, std::vector<std::string>& warnings) {
  const JsonReader positions = json.at("positions");
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Points points = points_of(positions, largest_coordinate, unknown);
  warn_of_unread(positions, points.unread, "vertex", "at rest instead", warnings);
  deform::Pose pose{std::move(points.all), {}};
  const auto turns_of = [&](const JsonReader& turns) {
    Points read = points_of(turns, largest_turn, 0);
    warn_of_unread(turns, read.unread, "part", "without full rotations instead", warnings);
    return std::move(read.all);
  };
  take_part(json, "turns", pose.turns, turns_of, "without full rotations", warnings);
  return pose;
}

void put_probe_pose(ordered_json& json, const deform::ProbePose& pose) {
  const deform::ProbePose rest;
  if (pose.turn != rest.turn) json["turned"] = pose.turn;
  if (six(pose.stretch) != six(rest.stretch)) json["stretched"] = six(pose.stretch);
  if (pose.move != rest.move) json["moved"] = pose.move;
}

deform::ProbePose probe_pose_of(const JsonReader& json) {
  deform::ProbePose pose;
  if (const auto v = json.find("turned")) pose.turn = short_vector(*v, largest_turn);
  if (const auto v = json.find("stretched")) pose.stretch = probe_stretch_of(*v);
  if (const auto v = json.find("moved")) pose.move = short_vector(*v, most_drawn);
  return pose;
}

namespace {

// The bytes of numbers as T, little-endian.
template <class T>
std::string bytes_of(const std::vector<mesh::Point>& points) {
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  std::string bytes;
  bytes.reserve(points.size() * 3 * sizeof(T));
  for (const mesh::Point& p : points) {
    for (const double x : p) {
      auto bits = std::bit_cast<Bits>(static_cast<T>(x));
      for (std::size_t i = 0; i < sizeof(T); ++i, bits >>= 8) bytes.push_back(static_cast<char>(bits & 255));
    }
  }
  return bytes;
}

template <class T>
SharedShape shape_of_bytes(const JsonReader& json) {
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  const std::string bytes = json.base64();
  if (bytes.size() % (3 * sizeof(T)) != 0) json.fail("its size is not three numbers for each vertex");
  std::vector<mesh::Point> points(bytes.size() / (3 * sizeof(T)));
  for (std::size_t n = 0; n < 3 * points.size(); ++n) {
    Bits bits = 0;
    for (std::size_t i = sizeof(T); i-- > 0;)
      bits = static_cast<Bits>(bits << 8) | static_cast<unsigned char>(bytes[n * sizeof(T) + i]);
    const auto x = static_cast<double>(std::bit_cast<T>(bits));
    if (!(std::abs(x) <= largest_coordinate)) json.fail("a number is too large");
    points[n / 3][n % 3] = x;
  }
  return std::make_shared<const std::vector<mesh::Point>>(std::move(points));
}

SharedShape read_shape(const JsonReader& json) {
  if (const auto floats = json.find("float32")) return shape_of_bytes<float>(*floats);
  return shape_of_bytes<double>(json.at("float64"));
}

}  // namespace

std::size_t ShapeTable::number_of(const SharedShape& shape) {
  const auto [entry, is_new] = numbers_.try_emplace(shape.get(), shapes_.size());
  if (is_new) shapes_.push_back(shape);
  return entry->second;
}

ordered_json ShapeTable::json() const {
  const auto is_float = [](const mesh::Point& p) {
    return std::ranges::all_of(p, [](double x) { return static_cast<double>(static_cast<float>(x)) == x; });
  };
  ordered_json all = ordered_json::array();
  for (const SharedShape& shape : shapes_) {
    const bool floats = std::ranges::all_of(*shape, is_float);
    all.push_back({{floats ? "float32" : "float64",
                    base::base64(floats ? bytes_of<float>(*shape) : bytes_of<double>(*shape))}});
  }
  return all;
}

std::vector<SharedShape> shapes_of(const JsonReader& json, std::vector<std::string>& warnings) {
  std::vector<SharedShape> shapes(json.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    try {
      shapes[i] = read_shape(json.item(i));
    } catch (const base::Error& error) {
      warnings.emplace_back(error.what());
    }
  }
  return shapes;
}

SharedShape shape_of(const JsonReader& json, std::span<const SharedShape> shapes) {
  const std::size_t number = json.index();
  if (number >= shapes.size() || !shapes[number]) json.fail("there is no such shape");
  return shapes[number];
}

ordered_json whole_pose_json(const WholePose& pose, ShapeTable& shapes) {
  ordered_json json = ordered_json::object();
  if (pose.shape) json["shape"] = shapes.number_of(pose.shape);
  if (!pose.cage.positions.empty()) json.update(pose_json(pose.cage));
  if (pose.probes.empty()) return json;
  json["probes"] = ordered_json::array();
  for (const auto& probe : pose.probes) {
    ordered_json one = ordered_json::object();
    put_probe_pose(one, probe);
    json["probes"].push_back(std::move(one));
  }
  return json;
}

SharedPose whole_pose_of(const JsonReader& json, std::span<const SharedShape> shapes,
                         std::vector<std::string>& warnings) {
  WholePose pose;
  if (const auto number = json.find("shape")) pose.shape = shape_of(*number, shapes);
  if (json.find("positions")) pose.cage = pose_of(json, warnings);
  if (const auto probes = json.find("probes")) {
    if (probes->size() > most_probes) probes->fail("there are too many probes");
    for (std::size_t i = 0; i < probes->size(); ++i) pose.probes.push_back(probe_pose_of(probes->item(i)));
  }
  return std::make_shared<const WholePose>(std::move(pose));
}

ordered_json library_json(const PoseLibrary& library, ShapeTable& shapes) {
  ordered_json all = ordered_json::array();
  for (const NamedPose& named : library.poses) {
    ordered_json json = {{"name", named.name}};
    if (named.weight != 0) json["weight"] = percent_of(named.weight);
    if (!named.part.empty()) json["part"] = named.part;
    json.update(whole_pose_json(*named.pose, shapes));
    all.push_back(std::move(json));
  }
  return all;
}

ordered_json timeline_json(const Timeline& timeline, double frame, ShapeTable& shapes) {
  ordered_json json = {{"first", timeline.first},
                       {"last", timeline.last},
                       {"rate", timeline.rate},
                       {"frame", frame},
                       {"repeat", entry_of(timeline.repeat).word}};
  if (timeline.straight) json["straight"] = true;
  json["keys"] = ordered_json::array();
  for (const PoseKey& key : timeline.keys) {
    ordered_json one = {{"frame", key.frame}, {"easing", entry_of(key.easing).word}};
    for (const MixedPose& mixed : key.mix)
      one["mix"].push_back({{"name", mixed.name}, {"weight", percent_of(mixed.weight)}});
    one.update(whole_pose_json(*key.pose, shapes));
    json["keys"].push_back(std::move(one));
  }
  for (const PoseKey& left : timeline.unkeyed) {
    ordered_json one = {{"frame", left.frame}};
    one.update(whole_pose_json(*left.pose, shapes));
    json["unkeyed"].push_back(std::move(one));
  }
  if (timeline.cameras.empty()) return json;
  json["cameras"] = ordered_json::array();
  for (const CameraKey& key : timeline.cameras) {
    ordered_json one = {{"frame", key.frame}};
    one.update(camera_json(key.camera));
    json["cameras"].push_back(std::move(one));
  }
  return json;
}

PoseLibrary library_of(const JsonReader& json, std::span<const SharedShape> shapes,
                       std::vector<std::string>& warnings) {
  PoseLibrary library;
  take_items(json, PoseLibrary::most_poses, "this pose is left out", warnings, [&](const JsonReader& item) {
    NamedPose named = named_pose_of(item, shapes, warnings);
    named.name = free_name(library, named.name);  // names are unique
    library.poses.push_back(std::move(named));
  });
  return library;
}

Timeline timeline_of(const JsonReader& json, double& frame, std::span<const SharedShape> shapes,
                     std::vector<std::string>& warnings) {
  Timeline t;
  const auto take = [&](const char* key, auto& part, auto read, const char* instead) {
    take_part(json, key, part, read, instead, warnings);
  };
  take("first", t.first, frame_of, "1 instead");
  take("last", t.last, frame_of, "60 instead");
  t.first = std::min(t.first, Timeline::largest_frame - 1);
  t.last = std::max(t.last, t.first + 1);
  const auto rate_of = [](const JsonReader& v) {
    return v.number(Timeline::least_rate, Timeline::largest_rate);
  };
  const auto read_keys = [&](const JsonReader& v) { return keys_of(v, shapes, warnings); };
  const auto read_cameras = [&](const JsonReader& v) { return cameras_of(v, warnings); };
  take("rate", t.rate, rate_of, "24 frames a second instead");
  take("repeat", t.repeat, choice_of<Repeat>, "loop instead");
  take("straight", t.straight, &JsonReader::boolean, "in log space instead");
  take("keys", t.keys, read_keys, "there are none instead");
  take("unkeyed", t.unkeyed, read_keys, "there are none instead");
  take("cameras", t.cameras, read_cameras, "there are none instead");
  put_in_order(t.keys);
  put_in_order(t.cameras);
  frame = t.first;
  take("frame", frame, frame_number, "at the first frame instead");
  return t;
}

void fit_poses(PoseLibrary& library, Timeline& timeline, const deform::Cage* cage, const mesh::Surface& model,
               const std::string& file, std::vector<std::string>& warnings) {
  const auto drop = [&](auto& all, const char* key, const char* what) {
    const std::size_t dropped =
        std::erase_if(all, [&](const auto& keyed) { return !fits(*keyed.pose, cage, model); });
    if (dropped > 0)
      warnings.push_back(file + ": " + key + ": " + std::to_string(dropped) + ' ' + what +
                         (dropped == 1 ? " is" : "s are") + " of another cage or model and dropped");
    if (cage)
      for (auto& keyed : all) rest_unread(keyed.pose, *cage);
  };
  drop(library.poses, "poses", "pose");
  drop(timeline.keys, "time", "key");
  drop(timeline.unkeyed, "time", "unkeyed pose");
  if (library.unmixed && !fits(*library.unmixed, cage, model)) library.unmixed = nullptr;
  if (library.unmixed && cage) rest_unread(library.unmixed, *cage);
  for (NamedPose& named : library.poses) {
    const auto unknown = [&](auto v) { return !cage || v >= cage->surface.positions.size(); };
    if (std::ranges::none_of(named.part, unknown)) continue;
    warnings.push_back(file + ": poses: " + mesh::in_quotes(named.name) +
                       " has weights for vertices that the cage does not have; it counts as edited directly");
    named.part.clear(), named.weight = 0;
  }
}

}  // namespace viete::scene
