// Defective cages in the real program: findings, their texts and highlights.
#include <cstdlib>

#include "mesh/formats/write.h"
#include "program/open_cage.h"
#include "support/commands.h"
#include "support/folder.h"

using namespace viete;
using test::dragon;
using test::dragon_cage;
using test::Driver;
using test::open_cage;

namespace {

namespace fs = std::filesystem;

// Highlight pixels in the view: much red, little green, unlike any model, cage or selection.
int highlighted(Driver& d) {
  const auto picture = d.picture();
  int count = 0;
  for (int y = 0; y < 760; ++y) {
    for (int x = 330; x < 1280; ++x) {
      const auto p = picture.pixel(x, y);
      count += p[0] > 190 && p[1] < 130 && p[2] > 90;
    }
  }
  return count;
}

const scene::Finding* find(Driver& d, scene::Defect defect) {
  for (const auto& finding : d.workspace().checks.findings) {
    if (finding.defect == defect) return &finding;
  }
  return nullptr;
}

std::string widget_of(Driver& d, const scene::Finding* finding) {
  return "finding/" + std::to_string(finding - d.workspace().checks.findings.data());
}

}  // namespace

TEST_CASE("a_sound_model_and_cage_show_no_finding") {
  Driver d;
  d.workspace().view.axes = false;
  REQUIRE(d.open({dragon, dragon_cage}));
  d.settle();
  CHECK(!d.workspace().checks.running);
  CHECK(d.workspace().checks.findings.empty());
  CHECK(!d.viewer().recorder().find("finding/0"));
}

TEST_CASE("an_open_cage_is_found_and_a_click_shows_where") {
  const test::TemporaryFolder scratch;
  Driver d(test::with_pixels);
  d.workspace().view.axes = false;
  REQUIRE(d.open({dragon, open_cage(scratch.path())}));
  d.settle();
  const auto* open = find(d, scene::Defect::open);
  REQUIRE(open);
  CHECK(open->edges.size() == 3);
  const auto before = d.workspace().camera.pose();
  CHECK(highlighted(d) == 0);
  d.click(widget_of(d, open));
  d.settle();
  CHECK(d.workspace().camera.pose().distance < before.distance);
  CHECK(highlighted(d) > 100);

  // Steps through the edges; then hides them.
  const int all = highlighted(d);
  d.click("finding_next");
  d.settle();
  CHECK(d.workspace().checks.element == 0u);
  CHECK(highlighted(d) > 30);
  CHECK(highlighted(d) != all);
  d.click(widget_of(d, open));
  d.settle();
  CHECK(highlighted(d) == 0);
}

TEST_CASE("the_highlight_follows_the_cage_when_it_is_dragged") {
  const test::TemporaryFolder scratch;
  Driver d(test::with_pixels);
  d.workspace().view.axes = false;
  REQUIRE(d.open({dragon, open_cage(scratch.path())}));
  d.settle();
  d.click(widget_of(d, find(d, scene::Defect::open)));
  d.settle();
  const auto edge = find(d, scene::Defect::open)->edges[0];
  d.move({700, 20});
  const auto shot = [&] {
    return d.picture().pixel(static_cast<int>(d.vertex(edge[0]).x), static_cast<int>(d.vertex(edge[0]).y));
  };
  auto& pose = d.document().changed_pose().positions;
  for (auto& p : pose) p[1] += 0.02 * d.document().space.diagonal();
  d.frame(3);
  CHECK(shot()[0] > 150);
  CHECK(shot()[1] < 150);
}

TEST_CASE("vertices_outside_are_counted_and_shown_and_go_with_the_cage") {
  const test::TemporaryFolder scratch;
  auto cage = *scene::open_surface(dragon_cage).surface;
  for (auto& p : cage.positions) p[1] -= 0.3;
  const fs::path low = scratch / "low.obj";
  mesh::write(low, cage);
  Driver d(test::with_pixels);
  d.workspace().view.axes = false;
  REQUIRE(d.open({dragon, low}));
  d.settle();
  const auto* outside = find(d, scene::Defect::vertices_outside);
  REQUIRE(outside);
  CHECK(outside->size() > 100);
  d.click(widget_of(d, outside));
  d.settle();
  CHECK(highlighted(d) > 500);
  REQUIRE(d.open({dragon_cage}, Driver::What::cage));
  d.frame();
  CHECK(d.workspace().checks.findings.empty());
  CHECK(!d.workspace().checks.shown);
  d.settle();
  CHECK(d.workspace().checks.findings.empty());
  CHECK(highlighted(d) == 0);
}

TEST_CASE("checks_run_aside_while_frames_go_on") {
  Driver d;
  d.workspace().view.axes = false;
  REQUIRE(d.open({dragon, dragon_cage}));
  d.frame();
  // The frame that started the checks must not wait for them.
  CHECK(d.until([&] { return !d.viewer().checking(); }));
  CHECK(!d.workspace().checks.running);
}

TEST_CASE("the_next_step_with_an_own_model_is_one_thing_at_a_time_until_work_begins") {
  const test::TemporaryFolder scratch;
  auto cage = *scene::open_surface(dragon_cage).surface;
  for (auto& p : cage.positions) p[1] -= 0.3;
  const fs::path low = scratch / "low.obj";
  mesh::write(low, cage);
  Driver d;
  d.document().scheme = deform::default_scheme();
  const auto offers = [&](const char* widget) {
    d.frame(2);
    const auto rect = d.viewer().recorder().find(widget);
    const auto& v = d.workspace().viewport;
    return rect && rect->x0 > v.origin.x && rect->x1 < v.origin.x + v.size.x;  // in the view, not in a column
  };
  REQUIRE(d.open({dragon}));
  d.settle();
  CHECK(offers("make_cage"));
  CHECK_FALSE(offers("enclose_model"));
  CHECK(d.document().scheme == deform::default_scheme());  // chosen by `bench modes`
  REQUIRE(d.open({low}, Driver::What::cage));
  d.settle();
  d.viewer().finish_checks();
  CHECK(offers("enclose_model"));
  CHECK_FALSE(offers("make_cage"));
  if (const char* pictures = std::getenv("VIETE_PICTURES"))
    render::write_png(fs::path(pictures) / "next_step.png", d.picture());
  d.click("enclose_model");
  d.frame(2);
  d.viewer().finish_binding();
  d.viewer().finish_checks();
  CHECK_FALSE(offers("enclose_model"));
  CHECK_FALSE(offers("hide_cage_offer"));
  d.press_key('Z', true);
  d.settle();
  d.viewer().finish_checks();
  CHECK(offers("hide_cage_offer"));
  d.click("hide_cage_offer");
  CHECK_FALSE(offers("enclose_model"));
  REQUIRE(d.open({low}, Driver::What::cage));
  d.settle();
  d.viewer().finish_checks();
  CHECK(offers("hide_cage_offer"));
  d.press_key(scene::key('A'));  // an edit
  CHECK_FALSE(offers("hide_cage_offer"));
}

namespace {

bool is_in_the_view(Driver& d, const std::string& widget) {
  d.frame(2);
  const auto rect = d.viewer().recorder().find(widget);
  const auto& v = d.workspace().viewport;
  return rect && rect->visible && rect->x0 > v.origin.x && rect->x1 < v.origin.x + v.size.x &&
         rect->y1 < v.origin.y + v.size.y;
}

// A cage of the dragon that leaves a part of it outside.
fs::path low_cage(const fs::path& folder) {
  auto cage = *scene::open_surface(dragon_cage).surface;
  for (auto& p : cage.positions) p[1] -= 0.3;
  mesh::write(folder / "low.obj", cage);
  return folder / "low.obj";
}

void check(Driver& d) {
  d.settle();
  d.viewer().finish_checks();
  d.frame(2);
}

}  // namespace

TEST_CASE("a_badge_in_the_view_names_a_defect_during_cage_editing_and_offers_a_remedy") {
  const test::TemporaryFolder scratch;
  Driver d;
  REQUIRE(d.open({dragon, low_cage(scratch.path())}));
  check(d);
  CHECK_FALSE(is_in_the_view(d, "badge"));  // a larger offer is shown at first
  test::run_command(d.workspace(), "edit_cage");
  check(d);
  REQUIRE(is_in_the_view(d, "badge"));
  CHECK(d.workspace().checks.badge->title.ends_with("vertices outside the cage"));
  if (const char* pictures = std::getenv("VIETE_PICTURES"))
    render::write_png(fs::path(pictures) / "badge.png", d.picture());
  // It stays while the checks run again, so that it does not move under the pointer.
  test::run_command(d.workspace(), "subdivide_cage");
  d.frame();
  CHECK(is_in_the_view(d, "badge"));
  check(d);
  d.click("badge/enclose_model");
  check(d);
  CHECK(find(d, scene::Defect::vertices_outside) == nullptr);
  const auto& badge = d.workspace().checks.badge;
  CHECK((!badge || !badge->title.ends_with("vertices outside the cage")));
}

TEST_CASE("a_badge_shows_its_elements_and_stays_dismissed") {
  const test::TemporaryFolder scratch;
  Driver d(test::with_pixels);
  d.workspace().view.axes = false;
  REQUIRE(d.open({dragon, open_cage(scratch.path())}));
  check(d);
  REQUIRE(is_in_the_view(d, "badge/show"));
  CHECK(highlighted(d) == 0);
  d.click("badge/show");
  d.settle();
  CHECK(highlighted(d) > 100);
  d.click("badge/close");
  test::run_command(d.workspace(), "edit_cage");
  test::run_command(d.workspace(), "subdivide_cage");
  check(d);
  CHECK(find(d, scene::Defect::open));
  CHECK_FALSE(is_in_the_view(d, "badge"));
}
