// Binding in the background: the view stays responsive, and a cancelled or failed binding changes nothing.
#include <chrono>
#include <fstream>
#include <thread>

#include "deform/bind.h"
#include "deform/binding.h"
#include "mesh/formats/write.h"
#include "mesh/shapes.h"
#include "program/driver.h"
#include "scene/document/binding_plan.h"
#include "scene/document/edit.h"
#include "scene/workspace/saving.h"
#include "support/commands.h"
#include "support/edits.h"
#include "support/folder.h"

using namespace viete;
using test::dragon;
using test::dragon_cage;
using test::Driver;
using What = scene::OpenRequest::What;

namespace {

namespace fs = std::filesystem;

// 8 * 4^levels triangles around the dragon.
fs::path ball_cage(const fs::path& folder, int levels) {
  const fs::path path = folder / ("ball" + std::to_string(levels) + ".ply");
  mesh::write(path, test::moved(test::sphere(levels), 5));
  return path;
}

std::vector<mesh::Point> deformed_positions(Driver& d) {
  const auto p = d.viewer().deformer()->positions();
  return {p.begin(), p.end()};
}

void open_dragon_with_pose(Driver& d) {
  d.open_dragon();
  const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
  d.drag(at, at + glm::vec2(40, 20));
  scene::mark_saved(d.workspace());  // so that replacing the cage needs no question
}

// Free memory in bytes, as reported by the system.
double free_memory() {
  std::ifstream in("/proc/meminfo");
  std::string key, rest;
  double kilobytes = 0;
  while (in >> key >> kilobytes && key != "MemAvailable:") std::getline(in, rest);
  return 1024 * kilobytes;
}

app::ViewerOptions small_window() {
  auto options = Driver::default_options();
  options.size = {640, 400};
  return options;
}

}  // namespace

TEST_CASE("cancelling_the_opening_of_a_cage_changes_nothing") {
  const test::TemporaryFolder folder;
  Driver d(small_window());
  open_dragon_with_pose(d);
  const auto* cage = d.document().cage.get();
  const auto before = deformed_positions(d);
  d.workspace().requests.open = scene::OpenRequest{What::cage, {ball_cage(folder.path(), 3)}};
  d.frame();
  REQUIRE(d.workspace().loading.running);
  d.press_key(scene::Key::escape);
  REQUIRE(d.until([&] { return !d.viewer().loading(); }));
  CHECK(d.document().cage.get() == cage);
  CHECK(test::edit_count(d.document().history) == 1);
  CHECK(deformed_positions(d) == before);
  CHECK(d.workspace().messages.all().back().text.starts_with("Cancelled "));
}

TEST_CASE("a_cage_that_is_opened_comes_with_its_binding") {
  const test::TemporaryFolder folder;
  Driver d(small_window());
  open_dragon_with_pose(d);
  const auto* cage = d.document().cage.get();
  d.workspace().requests.open = scene::OpenRequest{What::cage, {ball_cage(folder.path(), 1)}};
  REQUIRE(d.until([&] {
    // A document always has a deformer.
    REQUIRE(d.viewer().deformer());
    return d.document().cage.get() != cage;
  }));
  CHECK(d.document().cage->element_count() == 32);
  CHECK(d.viewer().deformer()->sample_matrices(10).size() > 0);
}

TEST_CASE("an_opened_document_is_bound_once_for_the_chosen_method") {
  const test::TemporaryFolder folder;
  const fs::path balls[] = {ball_cage(folder.path(), 1), ball_cage(folder.path(), 2)};
  Driver d(small_window());
  d.document().put_method(sym3::Method::diag);
  for (const auto& request :
       {scene::OpenRequest{What::model, {balls[1], dragon_cage}}, scene::OpenRequest{What::cage, {balls[0]}},
        scene::OpenRequest{What::model, {folder / "a.viete"}}}) {
    const auto opened = d.workspace().opened;
    bool bound_again = false;
    d.workspace().requests.open = request;
    d.frame();
    REQUIRE(d.until([&] {
      bound_again |= d.workspace().binding.running;
      return d.workspace().opened != opened;
    }));
    d.frame();
    bound_again |= d.workspace().binding.running;
    CHECK_FALSE(bound_again);
    CHECK(d.document().method == sym3::Method::diag);
    REQUIRE(d.viewer().deformer());
    CHECK(d.viewer().deformer()->engine(sym3::Method::diag) == deform::EngineKind::staged);
    REQUIRE(scene::save_session(d.workspace(), folder / "a.viete"));
    d.document().put_method(request.what == What::cage ? sym3::Method::fast : sym3::Method::diag);
  }
}

TEST_CASE("a_binding_that_does_not_fit_is_refused_with_numbers_and_everything_stays" *
          doctest::test_suite(test::if_present)) {
  const double needed = static_cast<double>(deform::binding_bytes(3000, 8u << 16, deform::EngineKind::fused));
  if (0.9 * free_memory() > needed) {
    test::skip("this machine has room for it");
    return;
  }
  const test::TemporaryFolder folder;
  Driver d(small_window());
  open_dragon_with_pose(d);
  const auto* cage = d.document().cage.get();
  const auto before = deformed_positions(d);
  d.workspace().requests.open = scene::OpenRequest{What::cage, {ball_cage(folder.path(), 8)}};
  d.frame();
  REQUIRE(d.until([&] { return !d.viewer().loading(); }));
  CHECK(d.document().cage.get() == cage);
  CHECK(deformed_positions(d) == before);
  CHECK(test::edit_count(d.document().history) == 1);
  const auto& message = d.workspace().messages.all().back();
  CHECK(message.severity == scene::Severity::error);
  for (const char* part :
       {"3000 vertices", "524288 cage elements", " GB of memory", "are free", "coarser cage"}) {
    CHECK_MESSAGE(message.text.find(part) != std::string::npos, message.text);
  }
}

TEST_CASE("other_weights_are_bound_while_the_old_ones_serve_and_a_cancel_keeps_them") {
  Driver d(small_window());
  d.open_dragon();
  for (const char* weights : {"weights_mean_value", "weights_biharmonic"}) {
    CAPTURE(weights);
    const auto before = deformed_positions(d);
    d.document().changed_pose().positions[0][1] += 0.3;
    test::run_command(d.workspace(), weights);
    d.frame();  // starts the new binding and deforms with the old one
    REQUIRE(d.workspace().binding.running);
    CHECK(d.workspace().binding.what.starts_with("Binding 3,000 vertices to "));
    const auto moved = deformed_positions(d);
    CHECK(moved != before);
    d.press_key(scene::Key::escape);
    CHECK_FALSE(d.workspace().binding.running);
    CHECK(d.document().scheme.weighting.weights == deform::Weights::inverse);
    CHECK(deformed_positions(d) == moved);
    CHECK_FALSE(d.viewer().deformer()->sample_matrices(10).empty());
  }
  test::run_command(d.workspace(), "weights_mean_value");
  d.settle();
  CHECK(d.viewer().deformer()->sample_matrices(10).empty());
}

TEST_CASE("the_cost_of_a_binding_is_known_before_it_starts") {
  Driver d(small_window());
  open_dragon_with_pose(d);
  const auto plan = scene::binding_plan(d.document(), {deform::Elements::point});
  CHECK(plan.handles == d.document().pose.positions.size());
  CHECK(plan.bytes ==
        deform::binding_bytes(3000, plan.handles, deform::EngineKind::fused, {deform::Elements::point}));
  CHECK(scene::text(plan).rfind("Binding 3,000 vertices to 76 vertices, ", 0) == 0);
}
