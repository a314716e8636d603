// Moves the cage: its rings turned about the joints of the dragon.
#pragma once

#include <vector>

#include "dragon/cage.h"

namespace viete::dragon {

inline constexpr Vec3 kForward{1, 0, 0}, kUp{0, 1, 0}, kLeft{0, 0, 1};

/// Moves a copy of a cage ring by ring.
class Poser {
public:
  explicit Poser(const Cage& cage) : cage_(cage), mesh_(cage.mesh) {}

  /// Turns the rings together about an axis through pivot; by 0 degrees nothing moves at all.
  void turn(const std::vector<Ring>& rings, Vec3 pivot, Vec3 axis, double degrees) {
    if (degrees == 0) return;
    for (const Ring& ring : rings) {
      for (std::uint32_t v : ring)
        mesh_.positions[v] = pivot + rotated(mesh_.positions[v] - pivot, axis, degrees);
    }
  }

  /// The middle of a ring as it stands now.
  Vec3 middle(const Ring& ring) const {
    Vec3 sum;
    for (std::uint32_t v : ring) sum = sum + mesh_.positions[v];
    return sum * (1.0 / static_cast<double>(ring.size()));
  }

  /// Bends neck and head about their joints, each joint by its share of the angles.
  void bend_neck(double pitch, double yaw) {
    const std::vector<Ring> joints{cage_.trunk[2], cage_.neck[0], cage_.neck[1]};
    std::vector<Ring> beyond{cage_.neck[0], cage_.neck[1], cage_.crown, cage_.muzzle};
    for (const Ring& joint : joints) {
      const Vec3 pivot = middle(joint);
      turn(beyond, pivot, kUp, yaw / 3);
      turn(beyond, pivot, rotated(kLeft, kUp, yaw / 3), pitch / 3);
      beyond.erase(beyond.begin());
    }
  }

  void turn_head(Vec3 axis, double degrees) {
    turn({cage_.crown, cage_.muzzle}, middle(cage_.neck[1]), axis, degrees);
  }

  /// Bends the tail about each of its rings.
  void bend_tail(double pitch, double yaw) {
    std::vector<Ring> beyond{cage_.tail[0], cage_.tail[1], cage_.tail[2], cage_.tail[3]};
    for (const Ring& joint : {cage_.trunk[0], cage_.tail[3], cage_.tail[2], cage_.tail[1]}) {
      const Vec3 pivot = middle(joint);
      turn(beyond, pivot, kLeft, pitch / 4);
      turn(beyond, pivot, kUp, yaw / 4);
      beyond.pop_back();
    }
  }

  /// Turns both wings about the shoulders; positive angles lower them, and sweep them back.
  void turn_wings(double lower, double sweep) {
    for (int i : {0, 1}) {
      const double side = i == 0 ? 1 : -1;
      const Vec3 shoulder{0.10, 0.80, 0.12 * side};
      turn({cage_.wing_hands[i], cage_.wing_tips[i]}, shoulder, kForward, lower * side);
      turn({cage_.wing_hands[i], cage_.wing_tips[i]}, shoulder, kUp, sweep * side);
    }
  }

  /// Turns the tips of both wings about the hands.
  void turn_wing_tips(double lower) {
    for (int i : {0, 1}) {
      turn({cage_.wing_tips[i]}, middle(cage_.wing_hands[i]), kForward, i == 0 ? lower : -lower);
    }
  }

  void turn_feet(double hind, double front) {
    for (int i : {0, 1, 2, 3}) {
      const Vec3 hip = i < 2 ? Vec3{-0.28, 0.50, 0} : Vec3{0.25, 0.55, 0};
      turn({cage_.feet[i]}, hip, kLeft, i < 2 ? hind : front);
    }
  }

  void lift(double height) {
    for (Vec3& p : mesh_.positions) p.y += height;
  }

  Mesh take() { return mesh_; }

private:
  const Cage& cage_;
  Mesh mesh_;
};

}  // namespace viete::dragon
