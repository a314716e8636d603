// Twists of a tube: the mesh must follow the cage through full turns without tears.
#include <doctest/doctest.h>

#include "deform/bound.h"

using namespace viete;
using namespace viete::test;

namespace {

// A tear separates neighbours by the size of the model: its edges stretch far more than those of the cage.
constexpr double tear = 1.5;

struct Twisted {
  double stretch, cage_stretch, distance;
  std::size_t torn;
};

Twisted twisted(Bound& b, const Twist& twist, std::vector<Vec3>& turns) {
  const Pose pose = b.pose(twist, turns);
  const auto positions = b.deform(pose);
  turns = b.report().turns;
  return {largest_edge_stretch(b.model, positions), largest_edge_stretch(b.cage->surface, pose.positions),
          largest_distance(positions, mapped(b.model.positions, twist)), b.report().torn.size()};
}

}  // namespace

TEST_CASE("a_tube_twisted_from_both_ends_does_not_tear_up_to_400_degrees") {
  for (const auto& [rings, sides] : {std::pair{9u, 6u}, {17u, 8u}, {25u, 12u}}) {
    Bound b(tube(60, 24, 0.18, 1.96), tube(rings, sides, 0.3, 2));
    for (int a = 0; a <= 400; a += 20) {
      std::vector<Vec3> none;
      const auto t = twisted(b, {2, {0, 0, 0}, -1, 1, -a / 2 * degree, a / 2 * degree}, none);
      CHECK(t.torn == 0);
      CHECK(t.stretch < tear * t.cage_stretch);
      CHECK(t.distance < 0.18);  // at most the tube's own radius
    }
  }
}

TEST_CASE("a_tube_twisted_from_one_end_does_not_tear_up_to_280_degrees") {
  for (const auto& [rings, sides] : {std::pair{9u, 6u}, {17u, 8u}}) {
    Bound b(tube(60, 24, 0.18, 1.96), tube(rings, sides, 0.3, 2));
    for (int a = 0; a <= 280; a += 20) {
      std::vector<Vec3> none;
      const auto t = twisted(b, {2, {0, 0, 0}, -1, 1, 0, a * degree}, none);
      CHECK(t.torn == 0);
      CHECK(t.stretch < tear * t.cage_stretch);
    }
  }
}

TEST_CASE("a_twist_beyond_the_range_of_logs_is_reported") {
  Bound b(tube(60, 24, 0.18, 1.96), tube(17, 8, 0.3, 2));
  std::vector<Vec3> none;
  CHECK(twisted(b, {2, {0, 0, 0}, -1, 1, -350 * degree, 350 * degree}, none).torn > 0);
}

TEST_CASE("twists_grow_without_jumps_and_unwind_exactly") {
  Bound b(tube(60, 24, 0.18, 1.96), tube(17, 8, 0.3, 2));
  std::vector<Vec3> turns;
  std::vector<mesh::Point> before;
  for (int a = 0; a <= 400; a += 2) {
    twisted(b, {2, {0, 0, 0}, -1, 1, -a / 2 * degree, a / 2 * degree}, turns);
    const auto now = b.deformer.positions();
    if (!before.empty()) CHECK(largest_distance(now, before) < 4 * degree * 0.3);
    before.assign(now.begin(), now.end());
  }
  for (int a = 400; a >= 0; a -= 10)
    twisted(b, {2, {0, 0, 0}, -1, 1, -a / 2 * degree, a / 2 * degree}, turns);
  CHECK(largest_distance(b.deformer.positions(), b.model.positions) < 1e-14 * b.cage->diagonal);
}
