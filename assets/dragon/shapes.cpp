#include "dragon/shapes.h"

#include <utility>

#include "dragon/poser.h"
#include "dragon/skeleton.h"

namespace viete::dragon {
namespace {

using Bends = std::vector<Bend>;

/// A limb of the left and its like of the right.
void bend_both(Bends& bends, int limb, double from, double to, Vec3 axis, double degrees) {
  bends.push_back({limb, from, to, axis, degrees});
  bends.push_back({limb + 1, from, to, mirrored(axis) * -1, degrees});
}

/// Upper arms back and down, elbows and hands closed.
void fold_wings(Bends& bends, double inwards, double upright, double lower, double elbow) {
  const Vec3 across = wing_frame(1).normal;
  bend_both(bends, kArm, 0, 1.2, kUp, -inwards);
  bend_both(bends, kArm, 0, 1.2, kForward, -upright);
  bend_both(bends, kArm, 0, 1.2, across, -lower);
  bend_both(bends, kArm, 1.6, 2.6, across, elbow);
  const double close[kFingers] = {61, 43, 33, 25};
  for (int i = 0; i < kFingers; ++i) bend_both(bends, kFinger + 2 * i, 0, 1.5, across, -close[i]);
}

/// Looking back over the left wing.
Bends folded() {
  Bends bends{{kTrunk, 3, 9.5, kUp, -165}, {kTail, 0.5, 6, kUp, -100}, {kTail, 0.2, 2.5, kLeft, -28}};
  fold_wings(bends, 27, 18, 32, 68);
  return bends;
}

/// Lying in a ring about its left side, the chin on the tail.
Bends coiled() {
  Bends bends{{kTail, 0.1, 6.5, kUp, 220}, {kTail, 0.1, 1.5, kLeft, -37}, {kTail, 2, 6.5, kLeft, 84},
              {kTrunk, 0.5, 3, kUp, -70},  {kTrunk, 3, 8.5, kUp, -125},   {kTrunk, 2, 5.5, kLeft, -90},
              {kTrunk, 6, 9.5, kLeft, 90}};
  bend_both(bends, kHindLeg, 0, 1.5, kLeft, 96);
  bend_both(bends, kHindLeg, 2.2, 3.4, kLeft, -141);
  bend_both(bends, kHindLeg, 4.5, 5.5, kLeft, 55);
  bend_both(bends, kHindLeg, 6, 7, kLeft, -10);
  bend_both(bends, kFrontLeg, 0, 1.5, kLeft, -94);
  bend_both(bends, kFrontLeg, 2.2, 3.6, kLeft, 166);
  bend_both(bends, kFrontLeg, 5, 7, kLeft, -72);
  fold_wings(bends, 27, 14, 22, 68);
  return bends;
}

/// On its hind legs, the tail about them.
Bends sitting() {
  const Bend all_from_the_rump{kTail, -1, 0, kLeft, 38};
  Bends bends{{kTail, 1.2, 6, kUp, 225},  {kTail, 0, 2, kLeft, -80}, {kTail, 2, 6.5, kLeft, 88},
              all_from_the_rump,          {kTrunk, 3, 10, kUp, -30}, {kTrunk, 2, 6, kLeft, -35},
              {kTrunk, 0, 2.5, kLeft, -3}};
  bend_both(bends, kHindLeg, 0, 1.2, kLeft, 45);
  bend_both(bends, kHindLeg, 2.2, 3.4, kLeft, -112);
  bend_both(bends, kHindLeg, 4.5, 5.5, kLeft, 69);
  bend_both(bends, kHindLeg, 6, 7, kLeft, -40);
  bend_both(bends, kFrontLeg, 0, 1.5, kLeft, -35);
  bends.push_back({kFrontLeg + 1, 2.2, 3.6, kLeft, -14});  // the right paw stands further back
  bends.push_back({kFrontLeg + 1, 5, 7, kLeft, 14});
  fold_wings(bends, 27, 18, 25, 68);
  return bends;
}

}  // namespace

std::vector<Shape> dragon_shapes(const Mesh& dragon) {
  const Skeleton skeleton;
  std::vector<Shape> shapes;
  const std::pair<const char*, Bends> all[] = {
      {"shape_folded", folded()}, {"shape_coiled", coiled()}, {"shape_sitting", sitting()}};
  for (const auto& [name, bends] : all) {
    shapes.push_back({name, skeleton.carried(dragon, bends)});
    stand_on_ground(shapes.back().positions);
  }
  return shapes;
}

}  // namespace viete::dragon
