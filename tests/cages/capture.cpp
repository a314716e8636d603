#include "cages/capture.h"

#include <doctest/doctest.h>

#include "support/random.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::test;

namespace {

struct Ball {
  mesh::Surface points;
  mesh::Splats splats;

  explicit Ball(std::size_t count) {
    Random random(5);
    while (points.positions.size() < count)
      if (const mesh::Point p = random.vector(1); mesh::norm(p) < 1) add(p, 3);
  }
  void add(const mesh::Point& p, float opacity) {
    points.positions.push_back(p);
    splats.opacities.push_back(opacity);
  }
};

}  // namespace

TEST_CASE("faint_and_lonely_splats_are_outside_of_the_core") {
  Ball ball(2000);
  CHECK(cages::core_of(mesh::lent(ball.points), ball.splats).note.empty());
  for (int i = 0; i < 10; ++i) ball.add({40.0 + i, 0, 0}, 3);
  for (int i = 0; i < 7; ++i) ball.add({5, 0, 0}, -3);
  const auto [core, note] = cages::core_of(mesh::lent(ball.points), ball.splats);
  CHECK(core->positions.size() == 2000);
  CHECK(note.starts_with("7 splats with opacity below 0.05 and 10 lonely splats"));
}

TEST_CASE("a_capture_of_faint_splats_is_kept_whole") {
  Ball ball(100);
  for (float& opacity : ball.splats.opacities) opacity = -9;
  const auto [core, note] = cages::core_of(mesh::lent(ball.points), ball.splats);
  CHECK(core->positions.size() == 100);
  CHECK(note.empty());
}
