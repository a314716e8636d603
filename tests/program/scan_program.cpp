#include "program/desktop.h"
#include "program/driver.h"

using namespace viete;
using test::Driver;

TEST_CASE("a_scan_of_537374_vertices_loads_binds_and_is_dragged" * doctest::test_suite(test::if_present)) {
  const auto folder = test::shared_data("igea-1m");
  if (folder.empty()) return;
  Driver d(Driver::default_options({640, 400}));
  d.workspace().jobs.wishes.open(
      {files::OpenRequest::What::model, {folder / "mesh.ply", folder / "cage.obj"}});
  REQUIRE(d.until([&] { return d.document().has_cage() && !d.viewer().loading(); }));
  CHECK(d.document().model().summary.vertices == 537374);
  d.settle();
  REQUIRE(d.viewer().deformer()->positions().size() == 537374);

  const auto rest = d.viewer().deformer()->positions();
  const glm::vec2 from = glm::round(d.vertex(d.free_vertex()));
  d.move(from);
  d.button(0, true);
  for (int i = 1; i <= 3; ++i) d.move(from + glm::vec2(12, -8) * static_cast<float>(i));
  d.button(0, false);
  d.frame(2);
  const auto posed = d.viewer().deformer()->positions();
  std::size_t moved = 0, broken = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    moved += posed[i] != rest[i];
    for (const double x : posed[i]) broken += !std::isfinite(x);
  }
  CHECK(moved > rest.size() / 2);
  CHECK(broken == 0);

  d.press_key('Z', true);
  CHECK(rest == d.viewer().deformer()->positions());
}
