#include "dragon/poses.h"

#include "dragon/poser.h"

namespace viete::dragon {
namespace {

std::vector<Ring> everything(const Cage& cage) {
  Ring all(cage.mesh.positions.size());
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
  return {all};
}

Mesh alert(const Cage& cage) {
  Poser poser(cage);
  poser.bend_neck(12, -54);
  poser.turn_head(kUp, -8);
  poser.bend_tail(-30, 40);
  poser.turn_wings(-8, -6);
  return poser.take();
}

Mesh flight(const Cage& cage) {
  Poser poser(cage);
  poser.turn_wings(8, 16);
  poser.turn_wing_tips(-14);
  poser.bend_neck(-75, -6);
  poser.turn_head(kLeft, 40);
  poser.bend_tail(-16, -40);
  poser.turn_feet(-44, -38);
  poser.turn(everything(cage), {0, 0.6, 0}, kLeft, 20);
  return poser.take();
}

Mesh coil(const Cage& cage) {
  Poser poser(cage);
  poser.bend_tail(-30, 165);
  poser.bend_neck(-8, 60);
  poser.turn_head(kForward, 10);
  poser.turn_wings(10, 12);
  return poser.take();
}

}  // namespace

std::vector<Pose> dragon_poses(const Cage& cage) {
  return {
      {"pose_alert", "Viete dragon, cage posed: head raised and turned to look over the left wing",
       alert(cage)},
      {"pose_flight", "Viete dragon, cage posed: in flight, wings spread, neck stretched, legs drawn back",
       flight(cage)},
      {"pose_coil", "Viete dragon, cage posed: looking back to the right, tail coiled", coil(cage)}};
}

}  // namespace viete::dragon
