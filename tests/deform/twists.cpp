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

TEST_CASE("a_tube_twisted_from_both_ends_or_one_does_not_tear") {
  const struct {
    std::uint32_t rings, sides;
    double low, most, farthest;
  } cases[] = {{9, 6, -0.5, 400, 0.18},
               {17, 8, -0.5, 400, 0.18},
               {25, 12, -0.5, 400, 0.18},  // the radius
               {9, 6, 0, 280, 1},
               {17, 8, 0, 280, 1}};
  for (const auto& c : cases) {
    Bound b(tube(60, 24, 0.18, 1.96), tube(c.rings, c.sides, 0.3, 2));
    for (double a = 0; a <= c.most; a += 20) {
      std::vector<Vec3> none;
      const auto t = twisted(b, {2, {0, 0, 0}, -1, 1, c.low * a * degree, (1 + c.low) * a * degree}, none);
      CHECK(t.torn == 0);
      CHECK(t.stretch < tear * t.cage_stretch);
      CHECK(t.distance < c.farthest);
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
