// Binding in the background: the program reacts during binding, and a cancelled binding changes nothing.
#include "formats/write.h"
#include "program/driver.h"
#include "support/commands.h"
#include "support/edits.h"
#include "support/folder.h"
#include "support/shapes.h"
#include "weights/binding.h"
#include "workspace/open_save.h"

using namespace viete;
using test::Driver;
using What = files::OpenRequest::What;

namespace {

struct Bound : Driver {
  test::TemporaryFolder folder;

  Bound() : Driver(default_options({640, 400})) {
    open_dragon();
    const glm::vec2 at = glm::round(vertex(free_vertex()));
    drag(at, at + glm::vec2(40, 20));
    workspace::mark_saved(workspace());  // otherwise, the program asks before replacing the cage
  }
  // Opens a cage of 8 * 4^levels triangles around the dragon. Calls `act` after the first frame.
  template <class Act>
  void open_ball(int levels, const Act& act) {
    formats::write(folder / "ball.ply", test::moved(test::sphere(levels), 5));
    workspace().jobs.wishes.open({What::cage, {folder / "ball.ply"}});
    frame();
    act();
    REQUIRE(until([&] { return !viewer().loading(); }));
  }
  std::vector<mesh::Point> positions() {
    const auto p = viewer().deformer()->positions();
    return {p.begin(), p.end()};
  }
};

}  // namespace

TEST_CASE("cancelling_the_opening_of_a_cage_changes_nothing") {
  Bound d;
  const auto* cage = d.document().cage().get();
  const auto before = d.positions();
  d.open_ball(3, [&] {
    REQUIRE(d.workspace().jobs.loading.running);
    d.press_key(workspace::Key::escape);
  });
  CHECK(d.document().cage().get() == cage);
  CHECK(test::edit_count(d.document().history()) == 1);
  CHECK(d.positions() == before);
  CHECK(d.workspace().messages.all().back().text.starts_with("Cancelled "));
}

TEST_CASE("while_an_edited_cage_is_bound_no_fused_time_stands_among_the_staged_ones") {
  auto options = Driver::default_options({640, 400});
  options.probe = true;  // measures the methods
  Driver d(options);
  d.open_dragon();
  const auto& times = d.workspace().frame.method_times;
  REQUIRE(d.until([&] { return times.measured; }));
  test::run_command(d.workspace(), "subdivide_cage");
  int pictures = 0;
  CHECK(d.until([&] {
    if (d.workspace().jobs.binding.running) ++pictures;
    for (std::size_t row = 0; row < workspace::MethodTimes::fused; ++row)
      CHECK(times.stages[row][pose::Stage::fused] == 0);
    return pictures > 0 && !d.workspace().jobs.binding.running;
  }));
}

TEST_CASE("other_weights_are_bound_while_the_old_ones_serve_and_cancelling_keeps_them") {
  Bound d;
  const auto before = d.positions();
  d.document().changed_pose().positions[0][1] += 0.3;
  test::run_command(d.workspace(), "weights_mean_value");
  d.frame();  // starts the new binding and deforms with the old binding
  REQUIRE(d.workspace().jobs.binding.running);
  CHECK(d.workspace().jobs.binding.what.starts_with("Binding 3,000 vertices to "));
  const auto moved = d.positions();
  CHECK(moved != before);
  d.press_key(workspace::Key::escape);
  CHECK_FALSE(d.workspace().jobs.binding.running);
  CHECK(d.document().deformer().weighting.weights == pose::Weights::inverse);
  CHECK(d.positions() == moved);
  test::run_command(d.workspace(), "weights_mean_value");
  d.settle();
  CHECK(d.viewer().deformer()->sample_matrices(10).empty());
}
