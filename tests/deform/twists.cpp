// Twists a tube by full turns. The tube must follow the cage and must not tear.

#include "deform/bound.h"

using namespace viete::test;

namespace {

constexpr double tear = 1.5;  // limit of the ratio: largest edge stretch of the model / of the cage

}  // namespace

TEST_CASE("a_tube_twisted_from_both_ends_or_one_does_not_tear") {
  const struct {
    std::uint32_t rings, sides;
    double low, most, farthest;
  } cases[] = {{9, 6, -0.5, 400, 0.18},
               {17, 8, -0.5, 400, 0.18},
               {25, 12, -0.5, 400, 0.18},  // `farthest` is the radius of the model
               {9, 6, 0, 280, 1},
               {17, 8, 0, 280, 1}};
  for (const auto& c : cases) {
    Bound b(tube(60, 24, 0.18, 1.96), tube(c.rings, c.sides, 0.3, 2));
    for (double a = 0; a <= c.most; a += 20) {
      const Twist twist{2, {0, 0, 0}, -1, 1, c.low * a * degree, (1 + c.low) * a * degree};
      const Pose pose = b.pose(twist);
      const auto positions = b.deform(pose);
      CHECK(b.report().torn.empty());
      CHECK(largest_edge_stretch(b.model, positions) <
            tear * largest_edge_stretch(b.cage->surface, pose.positions));
      CHECK(largest_distance(positions, mapped(b.model.positions, twist)) < c.farthest);
    }
  }
}

TEST_CASE("a_twist_beyond_the_range_of_logs_is_reported") {
  Bound b(tube(60, 24, 0.18, 1.96), tube(17, 8, 0.3, 2));
  b.deform(b.pose(Twist{2, {0, 0, 0}, -1, 1, -350 * degree, 350 * degree}));
  CHECK_FALSE(b.report().torn.empty());
}
