// Shapes and pins, with simulated events: import, sliders, posing by a pin, export, and shapes in a cage.

#include "document/probes.h"
#include "formats/read.h"
#include "formats/write.h"
#include "interact/placing.h"
#include "program/driver.h"
#include "support/folder.h"
#include "workspace/saving.h"

using namespace viete;
using test::Driver;

namespace {

// The dragon and files of two shapes. In the shapes, the upper half is rotated to the left or to the right.
struct ShapeHand : Driver {
  test::TemporaryFolder folder;
  std::filesystem::path left = folder / "left.ply", right = folder / "right.ply";

  explicit ShapeHand(bool cage) {
    if (cage) {
      open_dragon();
    } else {
      REQUIRE(open({test::dragon}));
      settle();
    }
    write(left, 1.2);
    write(right, -1.2);
    workspace().jobs.wishes.open({What::dropped, {right, left}});
    frame();
    REQUIRE(until([&] { return document().library().poses.size() == 2; }));
    settle();
    frame(2);
  }
  void write(const std::filesystem::path& file, double angle) {
    mesh::Surface surface = *document().model().surface;
    const mesh::Bounds box = mesh::bounds(surface.positions);
    for (mesh::Point& p : surface.positions) {
      const double share = std::clamp((p[1] - box.low[1]) / (box.high[1] - box.low[1]), 0.0, 1.0);
      const double a = angle * share, x = p[0] - box.center()[0], z = p[2] - box.center()[2];
      p = {box.center()[0] + std::cos(a) * x + std::sin(a) * z, p[1],
           box.center()[2] - std::sin(a) * x + std::cos(a) * z};
    }
    formats::write(file, surface);
  }
  const document::NamedPose& pose(std::size_t i) { return document().library().poses[i]; }
};

}  // namespace

TEST_CASE("a_slider_turns_the_model_and_what_is_drawn_is_what_is_written") {
  for (const bool cage : {false, true}) {
    INFO(cage);
    ShapeHand d(cage);
    CHECK(d.pose(0).name == "left");
    d.click("pose_weight/1");  // a click in the center sets 50 %
    if (cage) d.document().changed_pose().positions[d.free_vertex()][1] += 0.4;
    d.settle();
    CHECK(d.pose(1).weight == doctest::Approx(0.5).epsilon(0.03));
    REQUIRE(d.document().shape());
    CHECK(d.drawn_error() < 2e-5);
    CHECK(workspace::has_unsaved_edits(d.workspace()));
    const auto file = d.folder / "out.ply";
    d.workspace().jobs.wishes.save(workspace::SaveFile::Content::model, file);
    d.frame();
    REQUIRE(d.until([&] { return !d.viewer().exporting(); }));
    const double off = test::largest_distance(formats::read(file).surface.positions, d.exact_positions());
    CHECK(off < 1e-6 * d.document().model().bounds.diagonal());
  }
}

TEST_CASE("a_pin_is_placed_by_a_key_dragged_by_the_mouse_and_the_sliders_move_with_it") {
  ShapeHand d(false);
  const auto& rest = d.document().model().surface->positions;
  // Adds a pin at the feet and a pin on the head.
  for (const mesh::Point& at : {mesh::Point{0.05, 0.1, 0.2}, mesh::Point{0.75, 1.35, 0}}) {
    d.move(glm::floor(d.on_screen(at)));
    d.press_key('P', false, false, true);
  }
  d.settle();
  REQUIRE(d.document().probes().all.size() == 2);
  const pose::Probe& pin = d.document().probes().all[1];
  REQUIRE(pin.pin);
  CHECK(pin.place == rest[pin.pin->vertex]);
  CHECK_FALSE(d.document().shape());
  d.press_key('Q');
  const glm::vec2 from = glm::floor(d.on_screen(document::probe_center(d.document(), 1)));
  d.press_and_move(from, from + glm::vec2(-50, 10));
  REQUIRE(d.document().shape());
  CHECK(std::abs(d.pose(0).weight) + std::abs(d.pose(1).weight) > 0.05);
  d.button(0, false);
  d.settle();
  CHECK_FALSE(d.workspace().frame.pins.is_due());
  const auto& shape = *d.document().shape();
  CHECK(mesh::norm(shape[pin.pin->vertex] - (pin.place + pin.pose.move)) < 1e-6);
  CHECK(glm::distance(d.on_screen(shape[pin.pin->vertex]), from + glm::vec2(-50, 10)) < 4);
  const std::uint32_t foot = d.document().probes().all[0].pin->vertex;
  CHECK(mesh::norm(shape[foot] - rest[foot]) < 1e-6);
  CHECK(d.drawn_error() < 2e-5);
  const auto posed = d.document().shape();
  const auto weight = d.pose(0).weight;
  const glm::vec2 now = glm::floor(d.on_screen(document::probe_center(d.document(), 1)));
  d.press_and_move(now, now + glm::vec2(60, 0));
  CHECK(d.document().shape() != posed);
  d.press_key(workspace::Key::escape);
  d.button(0, false);
  d.settle();
  CHECK(d.document().shape() == posed);
  CHECK(d.pose(0).weight == weight);
}

TEST_CASE("a_pin_under_a_rotated_cage_follows_the_cursor") {
  ShapeHand d(true);
  auto& cage = d.document().changed_pose().positions;
  for (mesh::Point& p : cage) p = {p[0], -p[2], p[1]};  // rotates the cage by 90 degrees about x
  d.settle();
  const mesh::Point head{0.75, 0, 1.35};
  d.move(glm::floor(d.on_screen(head)));
  d.press_key('P', false, false, true);
  d.settle();
  REQUIRE(d.document().probes().all.size() == 1);
  const pose::Probe& pin = d.document().probes().all[0];
  const mesh::Point before = document::pinned_vertex(d.document(), 0);
  CHECK(glm::distance(d.on_screen(before), d.on_screen(head)) < 12);
  interact::Transform up;
  up.shift = {0, 0.2, 0};
  REQUIRE(interact::place_probes(d.document(), d.document().state(), up));
  d.settle();
  const auto moved = document::pinned_vertex(d.document(), 0) - before;
  CHECK(mesh::norm(moved - mesh::Point{0, 0.2, 0}) < 0.02);
  CHECK(std::abs(pin.pose.move[2] + 0.2) < 0.02);  // relative to the shape
  CHECK(mesh::norm(document::pinned_vertex(d.document(), 0) - document::probe_center(d.document(), 0)) <
        1e-3);
}
