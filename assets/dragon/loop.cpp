#include "dragon/loop.h"

#include <cstdio>

#include "dragon/poser.h"
#include "dragon/poses.h"

namespace viete::dragon {
namespace {

/// Angles in degrees, as in Poser; lift in the dragon's units.
struct Stance {
  int frame;
  double neck_pitch, neck_yaw, head_yaw;
  double tail_pitch, tail_yaw;
  double wings_lower, wings_sweep, tips_lower;
  double hind_feet, front_feet, lift;
};

// Tips of wings come after: up while the wings go down.
constexpr Stance kStances[] = {
    {22, 22, -96, -12, -18, 26, -40, -14, -8, 0, 0, 0},      // wings up, looking back over the left one
    {35, 2, -100, -15, -36, 2, 32, 6, -20, -14, -10, 0.16},  // down: off the ground
    {57, 0, 80, 0, -22, -38, -38, -12, 14, -5, -4, 0.06},    // up, and the head has swept to the right
    {70, -4, 80, 0, -40, -16, 30, 6, -18, -14, -10, 0.18},   // down again
    {95, 16, 34, 4, -24, 30, -20, -12, 6, 0, 0, 0},          // landed
};
constexpr int kLastFrame = 121;

Mesh posed(const Cage& cage, const Stance& s) {
  Poser poser(cage);
  poser.bend_neck(s.neck_pitch, s.neck_yaw);
  poser.turn_head(kUp, s.head_yaw);
  poser.bend_tail(s.tail_pitch, s.tail_yaw);
  poser.turn_wings(s.wings_lower, s.wings_sweep);
  poser.turn_wing_tips(s.tips_lower);
  poser.turn_feet(s.hind_feet, s.front_feet);
  poser.lift(s.lift);
  return poser.take();
}

// As many decimals as the poses have as files.
std::string positions(const Mesh& mesh) {
  std::string text = "\"positions\": [";
  char line[96];
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    std::snprintf(line, sizeof line, "%s[%.4f, %.4f, %.4f]", v == 0 ? "" : ", ", p.x, p.y, p.z);
    text += line;
  }
  return text + "]";
}

std::string key(int frame, const Mesh& mesh) {
  return "      {\"frame\": " + std::to_string(frame) + ", \"easing\": \"smooth\", " + positions(mesh) + "}";
}

}  // namespace

std::string loop_session(const Cage& cage) {
  const std::vector<Pose> poses = dragon_poses(cage);
  const Mesh& alert = poses.front().mesh;
  std::string text =
      "{\n  \"format\": \"viete session\",\n  \"version\": 1,\n"
      "  \"model\": \"dragon.ply\",\n  \"cage\": \"cage.obj\",\n"
      "  \"weights\": \"biharmonic\", \"blend\": \"srl\",\n  \"poses\": [\n";
  for (std::size_t i = 0; i < poses.size(); ++i)
    text += "    {\"name\": \"" + poses[i].name.substr(std::string("pose_").size()) + "\", " +
            positions(poses[i].mesh) + (i + 1 < poses.size() ? "},\n" : "}\n");
  text += "  ],\n  \"time\": {\n    \"first\": 1, \"last\": " + std::to_string(kLastFrame) +
          ", \"rate\": 24, \"frame\": 1, \"repeat\": \"loop\",\n    \"keys\": [\n" + key(1, alert) + ",\n";
  for (const Stance& stance : kStances) text += key(stance.frame, posed(cage, stance)) + ",\n";
  return text + key(kLastFrame, alert) + "\n    ]\n  }\n}\n";
}

}  // namespace viete::dragon
