// Binding aside: the view stays live, and a binding that is cancelled or does not fit changes nothing.
#include <chrono>
#include <fstream>
#include <thread>

#include "deform/bind.h"
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
  scene::mark_saved(d.workspace());  // so that another cage takes its place without a question
}

// Bytes of memory that are free now, as the system says.
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

TEST_CASE("a_cage_is_bound_aside_with_its_size_and_a_cancel_leaves_everything") {
  const test::TemporaryFolder folder;
  Driver d(small_window());
  open_dragon_with_pose(d);
  // 51 MB and half a second; a machine that binds it in a moment gets more.
  for (int levels = 2;; ++levels) {
    REQUIRE_MESSAGE(levels < 5, "a fifth of a billion weights came at once");
    const auto* cage = d.document().cage.get();
    const auto before = deformed_positions(d);
    const auto pose = d.document().pose.positions;
    const auto edits = test::edit_count(d.document().history);
    d.workspace().requests.open = scene::OpenRequest{What::cage, {ball_cage(folder.path(), levels)}};
    bool bound = false, wrong = false;
    REQUIRE(d.until([&] {
      const auto& loading = d.workspace().loading;
      bound = loading.running && loading.what.rfind("Binding 50,000 vertices to ", 0) == 0;
      wrong |= loading.running && d.document().cage.get() != cage;
      return bound || (!loading.running && !d.workspace().requests.open);
    }));
    CHECK(!wrong);
    if (bound) {
      CHECK(d.workspace().loading.what.find(" MB") != std::string::npos);
      d.press_key(scene::Key::escape);
    }
    REQUIRE(d.until([&] { return !d.viewer().loading(); }));
    if (d.document().cage.get() != cage) {
      d.open_dragon();
      continue;  // it was there before the key was
    }
    CHECK(d.document().pose.positions == pose);
    CHECK(test::edit_count(d.document().history) == edits);
    CHECK(deformed_positions(d) == before);
    CHECK(d.workspace().messages.all().back().text.find("Stopped binding") != std::string::npos);
    break;
  }
}

TEST_CASE("a_cage_that_is_opened_comes_with_its_binding") {
  const test::TemporaryFolder folder;
  Driver d(small_window());
  open_dragon_with_pose(d);
  const auto* cage = d.document().cage.get();
  d.workspace().requests.open = scene::OpenRequest{What::cage, {ball_cage(folder.path(), 1)}};
  REQUIRE(d.until([&] {
    // Never a document without what deforms it.
    REQUIRE(d.viewer().deformer());
    return d.document().cage.get() != cage;
  }));
  CHECK(d.document().cage->element_count() == 32);
  CHECK(d.viewer().deformer()->sample_matrices(10).size() > 0);
}

TEST_CASE("what_was_opened_is_bound_once_for_the_method_that_was_chosen_before") {
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
  const double needed =
      static_cast<double>(deform::binding_bytes(50000, 8u << 16, deform::EngineKind::fused));
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
       {"50000 vertices", "524288 cage elements", " GB of memory", "are free", "coarser cage"}) {
    CHECK_MESSAGE(message.text.find(part) != std::string::npos, message.text);
  }
}

TEST_CASE("other_coordinates_are_bound_while_the_old_ones_serve_and_a_cancel_keeps_them") {
  const test::TemporaryFolder folder;
  Driver d(small_window());
  for (int levels = 2;; ++levels) {
    REQUIRE_MESSAGE(levels < 7, "mean value coordinates of 32768 triangles came at once");
    test::run_command(d.workspace(), "blend_srl");  // a new document keeps what the last one used
    scene::mark_saved(d.workspace());
    REQUIRE(d.open({dragon, ball_cage(folder.path(), levels)}));
    d.settle();
    const auto rest = deformed_positions(d);
    test::run_command(d.workspace(), "weights_mean_value");
    d.frame();
    if (!d.workspace().binding.running) continue;
    CHECK(d.workspace().binding.what.rfind("Binding 50,000 vertices to ", 0) == 0);
    const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
    d.click(at);  // so dense a cage is dragged by what is selected
    d.press_and_move(at, at + glm::vec2(30, 10));
    const bool live = d.workspace().binding.running;
    const auto during = deformed_positions(d);
    d.button(0, false);
    if (!live) continue;
    CHECK_MESSAGE(during != rest, "the mesh follows while it is bound anew");
    const auto moved = deformed_positions(d);
    d.press_key(scene::Key::escape);
    if (d.document().scheme.weighting.weights == deform::Weights::mean_value) continue;
    CHECK(!d.workspace().binding.running);
    CHECK(d.document().scheme.weighting.weights == deform::Weights::inverse);
    CHECK(deformed_positions(d) == moved);
    CHECK(!d.viewer().deformer()->sample_matrices(10).empty());
    break;
  }
  test::run_command(d.workspace(), "weights_mean_value");
  d.settle();
  CHECK(d.viewer().deformer()->sample_matrices(10).empty());
}

TEST_CASE("other_weights_are_bound_while_the_old_one_serves_and_a_cancel_keeps_it") {
  const test::TemporaryFolder folder;
  Driver d(small_window());
  for (int levels = 3;; ++levels) {
    REQUIRE_MESSAGE(levels < 6, "weights of 8192 triangles came at once");
    scene::set_scheme(d.document(), {});
    scene::mark_saved(d.workspace());
    REQUIRE(d.open({dragon, ball_cage(folder.path(), levels)}));
    d.settle();
    const auto rest = deformed_positions(d);
    scene::set_scheme(d.document(), deform::scheme_of(deform::Way::local));
    d.frame();
    if (!d.workspace().binding.running) continue;
    CHECK(d.workspace().binding.what.rfind("Binding 50,000 vertices to ", 0) == 0);
    d.press_key(scene::Key::escape);
    if (d.document().scheme.weighting.partial()) continue;
    CHECK(!d.workspace().binding.running);
    CHECK(d.document().scheme == deform::Scheme());
    CHECK(deformed_positions(d) == rest);
    break;
  }
}

TEST_CASE("what_a_binding_takes_is_known_before") {
  Driver d(small_window());
  open_dragon_with_pose(d);
  const auto plan = scene::binding_plan(d.document(), {deform::Elements::point});
  CHECK(plan.handles == d.document().pose.positions.size());
  CHECK(plan.bytes ==
        deform::binding_bytes(50000, plan.handles, deform::EngineKind::fused, {deform::Elements::point}));
  CHECK(scene::text(plan).rfind("Binding 50,000 vertices to 76 vertices, ", 0) == 0);
}
