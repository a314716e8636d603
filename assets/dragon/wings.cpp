#include <vector>

#include "dragon/anatomy.h"
#include "dragon/tube.h"
#include "dragon/wings.h"

namespace viete::dragon {
namespace {

using Polyline = std::vector<PlanePoint>;

constexpr PlanePoint kShoulder{0.00, 0.00}, kElbow{0.20, 0.30}, kWrist{-0.02, 0.70}, kArmpit{0.11, 0.07};
constexpr PlanePoint kTips[kFingers] = {{0.46, 1.27}, {0.87, 1.03}, {1.05, 0.69}, {0.90, 0.38}};

/// A finger arches from the wrist to its tip.
Polyline finger(int i) {
  const PlanePoint tip = kTips[i];
  const double lift = 0.16 - 0.05 * i;
  const PlanePoint control{0.5 * (kWrist.back + tip.back) - lift * (tip.out - kWrist.out) + 0.00,
                           0.5 * (kWrist.out + tip.out) + lift * (tip.back - kWrist.back)};
  Polyline points;
  append_arc(points, kWrist, control, tip, 10);
  points.push_back(tip);
  return points;
}

/// Shoulder, arm, first finger, then the scalloped rim back to the armpit.
Polyline outline() {
  Polyline points{kShoulder, {kElbow.back - 0.05, kElbow.out}};
  for (PlanePoint p : finger(0)) points.push_back(p);
  points.pop_back();
  PlanePoint ends[5] = {kTips[0], kTips[1], kTips[2], kTips[3], kArmpit};
  for (int i = 0; i < 4; ++i) {
    const PlanePoint a = ends[i], b = ends[i + 1];
    const PlanePoint pull = i < 3 ? kWrist : PlanePoint{kElbow.back + 0.06, kElbow.out + 0.02};
    const double depth = i < 3 ? 0.42 : 0.50;
    const PlanePoint middle{0.5 * (a.back + b.back), 0.5 * (a.out + b.out)};
    append_arc(points, a, {lerp(middle.back, pull.back, depth), lerp(middle.out, pull.out, depth)}, b, 10);
  }
  points.push_back(kArmpit);
  return points;
}

/// A place off the wing's plane.
Vec3 lifted(const WingFrame& frame, PlanePoint p, double lift) {
  return frame.place(p) + frame.normal * lift;
}

void add_claw(Field& field, const WingFrame& frame) {
  const auto at = [&](PlanePoint p, double lift) { return lifted(frame, p, lift); };
  const std::vector<Station> claw{round(at(kWrist, 0), 0.022), round(at({-0.055, 0.755}, 0.004), 0.015),
                                  round(at({-0.065, 0.81}, 0.0), 0.009),
                                  round(at({-0.050, 0.855}, -0.01), 0.0045)};
  field.join(std::make_unique<Tube>(claw, frame.normal), 0.008);
}

void add_wing(Field& field, double side) {
  const WingFrame frame = wing_frame(side);
  std::vector<Polyline> bones{{kShoulder, kElbow, kWrist}};
  for (int i = 0; i < kFingers; ++i) bones.push_back(finger(i));
  field.join(std::make_unique<Membrane>(frame, outline(), bones, 0.0075, 0.035), 0.015);
  for (int i = 0; i < kFingers; ++i)
    field.join(std::make_unique<Tube>(wing_finger(frame, i), frame.normal), 0.012);
  field.join(std::make_unique<Tube>(wing_arm(frame), frame.normal), 0.02);
  add_claw(field, frame);
}

}  // namespace

WingFrame wing_frame(double side) {
  const Vec3 out = normalized({-0.12, 0.89, 0.42 * side});
  const Vec3 rough_back = Vec3{-1, -0.05, 0.55 * side};
  const Vec3 back = normalized(rough_back - out * dot(rough_back, out));
  return {{0.16, 0.715, 0.115 * side}, back, out, cross(back, out) * side, 0.14};
}

std::vector<Station> wing_arm(const WingFrame& frame) {
  return {round(lifted(frame, {0.02, -0.06}, -0.01), 0.050), round(lifted(frame, {0.06, 0.07}, 0), 0.042),
          round(lifted(frame, kElbow, 0), 0.031), round(lifted(frame, {0.10, 0.50}, 0), 0.028),
          round(lifted(frame, kWrist, 0), 0.028)};
}

std::vector<Station> wing_finger(const WingFrame& frame, int i) {
  std::vector<Station> stations;
  const Polyline line = finger(i);
  const double last = static_cast<double>(line.size() - 1);
  for (std::size_t k = 0; k < line.size(); ++k)
    stations.push_back(round(frame.place(line[k]), lerp(0.019, 0.0085, static_cast<double>(k) / last)));
  return stations;
}

void add_wings(Field& field) {
  add_wing(field, 1);
  add_wing(field, -1);
}

}  // namespace viete::dragon
