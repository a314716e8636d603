// Cages with defects: messages, proposed repairs, badges and highlights.
#include "document/pose_edit.h"
#include "formats/write.h"
#include "mesh/triangle_tree.h"
#include "program/small_scene.h"
#include "support/commands.h"
#include "support/pictures.h"

using namespace viete;
using test::Driver;
namespace fs = std::filesystem;

namespace {

// A ball with two cages: one has a missing face, the other does not contain the whole ball.
struct Checked : test::SmallScene {
  fs::path holed = folder / "holed.obj", low = folder / "low.obj";

  explicit Checked(std::optional<test::WithPixels> pixels = {}, glm::ivec2 size = {1280, 800})
      : SmallScene(Driver::default_options(size), pixels) {
    d.workspace().view.options.axes = false;
    mesh::Surface cage = test::ball(1.2, 1);
    formats::write(holed,
                   mesh::from_triangles(cage.positions, {cage.triangles.begin() + 1, cage.triangles.end()}));
    for (auto& p : cage.positions) p[1] -= 0.5;
    formats::write(low, cage);
  }
  void check() {
    d.settle();
    d.viewer().finish_checks();
    d.frame(2);
  }
  void open_cage(const fs::path& cage) {
    REQUIRE(d.open({cage}, Driver::What::cage));
    check();
  }
  const document::Finding* find(document::Defect defect) {
    const auto& all = d.workspace().checks.findings;
    const auto found = std::ranges::find(all, defect, &document::Finding::defect);
    return found == all.end() ? nullptr : &*found;
  }
  // True if the widget is in the view and not in a column.
  bool shows(const std::string& widget) {
    d.frame(2);
    const auto rect = d.recorder().find(widget);
    const auto& v = d.workspace().view.camera.viewport;
    return rect && rect->visible && rect->x0 > v.origin.x && rect->x1 < v.origin.x + v.size.x &&
           rect->y1 < v.origin.y + v.size.y;
  }
  // Counts the pixels with the colour of highlights: much red and little green.
  int highlighted() {
    d.settle();
    const auto picture = d.picture();
    int count = 0;
    for (int y = 0; y < 760; ++y)
      for (int x = 330; x < 1280; ++x) {
        const auto p = picture.pixel(x, y);
        count += p[0] > 190 && p[1] < 130 && p[2] > 90;
      }
    return count;
  }
};

}  // namespace

TEST_CASE("a_click_on_a_finding_highlights_its_elements_which_follow_the_cage") {
  Checked c(test::with_pixels);
  Driver& d = c.d;
  CHECK(d.workspace().checks.findings.empty());
  CHECK_FALSE(d.recorder().find("finding/0"));
  c.open_cage(c.holed);
  const auto* open = c.find(document::Defect::open);
  REQUIRE(open);
  CHECK(open->edges.size() == 3);
  const std::string widget = "finding/" + std::to_string(open - d.workspace().checks.findings.data());
  const auto before = d.workspace().view.camera.pose();
  CHECK(c.highlighted() == 0);
  d.click(widget);
  const int all = c.highlighted();
  CHECK(d.workspace().view.camera.pose().distance < before.distance);
  CHECK(all > 100);
  d.click("finding_next");
  const int one = c.highlighted();
  CHECK(one > 30);
  CHECK(one < all);
  const auto edge = open->edges[0];
  for (auto& p : d.document().changed_pose().positions) p[1] += 0.02 * d.document().space().diagonal();
  d.move({700, 20});
  d.frame(3);
  const glm::ivec2 end(d.vertex(edge[0]));
  const auto pixel = d.picture().pixel(end.x, end.y);
  CHECK(pixel[0] > 150);
  CHECK(pixel[1] < 150);
  d.click(widget);
  CHECK(c.highlighted() == 0);
}

TEST_CASE("the_next_step_with_an_own_model_is_offered_until_work_begins") {
  Checked c;
  Driver& d = c.d;
  REQUIRE(d.open({c.folder / "ball.obj"}));
  d.settle();
  CHECK(c.shows("make_cage"));
  CHECK_FALSE(c.shows("enclose_model"));
  const float over_ground = d.recorder().find("hide_cage_offer")->y1;
  d.run("map_displacement");
  CHECK(c.shows("hide_cage_offer"));
  CHECK(d.recorder().find("hide_cage_offer")->y1 < over_ground - 40);  // above the legend
  d.run("map_none");
  c.open_cage(c.low);
  CHECK(c.shows("enclose_model"));
  CHECK_FALSE(c.shows("make_cage"));
  d.click("enclose_model");
  d.viewer().finish_binding();
  c.check();
  CHECK(mesh::points_outside(d.document().cage()->surface, d.document().model().surface->positions).empty());
  CHECK_FALSE(c.shows("enclose_model"));
  CHECK_FALSE(c.shows("hide_cage_offer"));
  d.press_key('Z', true);
  c.check();
  CHECK(c.shows("hide_cage_offer"));
  d.click("hide_cage_offer");
  CHECK_FALSE(c.shows("enclose_model"));
  c.open_cage(c.low);
  CHECK(c.shows("hide_cage_offer"));
  d.press_key(workspace::key('A'));  // makes an edit
  CHECK_FALSE(c.shows("hide_cage_offer"));
  c.open_cage(c.folder / "cage.obj");
  CHECK(d.workspace().checks.findings.empty());
}

TEST_CASE("the_offer_to_enclose_is_inside_a_narrow_view") {
  Checked c({}, {900, 600});
  c.open_cage(c.low);
  CHECK(c.shows("show_outside"));
  CHECK(c.shows("hide_cage_offer"));
  const auto rect = c.d.viewer().recorder().find("hide_cage_offer");
  CHECK(rect->x0 > c.d.viewer().recorder().find("strip/tool_move")->x1);
}

TEST_CASE("an_edit_of_the_cage_that_pushes_vertices_out_offers_to_enclose_the_model") {
  Checked c;
  formats::write(c.folder / "tight.obj", test::ball(1.1, 1));
  Driver& d = c.d;
  c.open_cage(c.folder / "tight.obj");
  CHECK_FALSE(c.shows("enclose_model"));
  const std::size_t before = d.workspace().checks.outside;
  d.run("edit_cage");
  d.document().changed_selection().apply(std::vector<std::uint32_t>{3}, document::SelectMode::replace);
  d.run("remove_elements");
  c.check();
  REQUIRE(d.workspace().checks.outside > before);
  CHECK(c.shows("enclose_model"));
  d.run("enclose_model");
  c.check();
  CHECK(d.workspace().checks.outside == 0);
  CHECK_FALSE(c.shows("hide_cage_offer"));
}

TEST_CASE("points_and_surfaces_open_with_the_users_deformer") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "points.obj", "v 0 0 0\nv 0.5 0 0\nv 0 0.5 0.5\n");
  Driver d;
  d.document().put_deformer(pose::default_deformer());
  REQUIRE(d.open({folder / "points.obj"}));
  CHECK(d.document().deformer() == pose::default_deformer());
  d.open_dragon();
  CHECK(d.document().deformer() == pose::default_deformer());
}

TEST_CASE("possible_folds_are_listed_in_the_checks_and_marked_on_the_cage") {
  Driver d(Driver::default_options({1440, 900}), test::with_pixels);
  d.open_dragon();
  d.workspace().preferences.layout.sections["Checks"] = true;
  d.settle();
  d.move({720, 880});
  CHECK_FALSE(d.recorder().find("pose_note/0"));
  const double middle =
      d.document().cage_file().bounds.low[0] +
      0.7 * (d.document().cage_file().bounds.high[0] - d.document().cage_file().bounds.low[0]);
  pose::Pose pose = d.document().pose();
  for (auto& p : pose.positions)
    if (p[0] > middle) p = {p[0], -p[1], -p[2]};
  document::set_pose(d.document(), pose);
  d.settle();
  REQUIRE_FALSE(d.workspace().frame.report.torn.empty());
  CHECK(d.recorder().find("pose_note/0"));
  CHECK(d.workspace().messages.all().empty());
  const auto with = d.picture();
  d.workspace().frame.report.torn.clear();
  d.frame();
  CHECK(test::difference(with, d.picture(), 0) > 0);  // the marks are visible
  document::reset_pose(d.document());
  d.settle();
  CHECK_FALSE(d.recorder().find("pose_note/0"));
}
