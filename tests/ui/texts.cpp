// The texts and the enabled widgets of panels, and what a click changes.
#include "support/text.h"
#include "ui/panel_driver.h"

using namespace viete;
using test::PanelDriver;

namespace {

// Returns the texts after the mouse has rested on a widget.
std::string hint_at(PanelDriver& d, const std::string& widget) {
  d.move(d.place_of(widget));
  d.frame(40);
  const std::string all = d.text();
  d.move({640, 790});
  d.frame(3);
  return all.substr(d.text().size());
}

}  // namespace

TEST_CASE("panels_show_the_size_of_surfaces_and_of_the_selection") {
  PanelDriver d;
  for (const char* section : {"Model", "Cage"}) d.workspace().preferences.layout.sections[section] = true;
  d.frame(3);
  CHECK(d.says("Model watertight 162 320 Vertices, triangles"));
  CHECK(d.says("larger ball 162 320 Vertices, triangles"));
  CHECK(d.says("0 of 162 Selected"));
  for (const char* widget : {"bend", "save_set", "transform_x", "soft_radius"})
    CHECK_FALSE(d.recorder().find(widget)->enabled);
  d.click("select_all");
  CHECK(d.says("162 of 162 Selected"));
  for (const char* widget : {"bend", "save_set", "transform_x"}) CHECK(d.recorder().find(widget)->enabled);
}

TEST_CASE("panels_name_splats_and_points_instead_of_triangles") {
  for (const bool capture : {true, false}) {
    mesh::Surface surface;
    surface.positions = test::ball(1, 2).positions;
    document::OpenedSurface points = document::generated_surface(std::move(surface), "points");
    auto splats = std::make_shared<mesh::Splats>();
    splats->resize(162);
    if (capture) points.splats = splats;
    workspace::Workspace w;
    w.document = document::Document(std::move(points));
    w.preferences.layout.sections["Model"] = true;
    w.view.options.field = analysis::Field::area;
    PanelDriver d(std::move(w));
    CHECK(d.says(capture ? "Model capture 162 Splats" : "Model points 162 Points"));
    CHECK_FALSE(d.says("triangles"));
    for (const char* section : {"Analysis", "Map"}) d.workspace().preferences.layout.sections[section] = true;
    d.frame(3);
    d.place_of("map");
    CHECK(d.says("this map needs a model with faces"));
  }
}

TEST_CASE("a_hint_names_the_key_of_the_keymap_and_the_reason_for_a_disabled_command") {
  PanelDriver d;
  CHECK(test::mentions(hint_at(d, "method_sd"), "eigenvalues by QR. (Shift+2)"));
  d.workspace().preferences.keymap.change("method_sd", {workspace::Key::f7});
  CHECK(test::mentions(hint_at(d, "method_sd"), "eigenvalues by QR. (F7)"));
  CHECK(test::mentions(hint_at(d, "bend"), "far end. Select part of the cage first."));
}

TEST_CASE("a_finding_is_listed_by_its_title_and_a_click_shows_it") {
  PanelDriver d(test::ball_workspace(2), {1280, 1500});
  CHECK_FALSE(d.has("finding/0"));
  auto& checks = d.workspace().checks;
  checks.findings = {
      {document::Defect::open, document::Subject::cage, document::ElementKind::edge, {}, {{0, 1}, {1, 2}}}};
  d.workspace().preferences.layout.sections["Checks"] = true;
  d.frame(3);
  CHECK(d.says(title(checks.findings[0])));
  d.click("finding/0");
  CHECK(checks.shown == std::size_t{0});
  d.frame();
  CHECK(d.says(meaning(checks.findings[0])));
  d.click("finding_next");
  CHECK(checks.element == std::size_t{0});
  d.click("finding/0");
  CHECK_FALSE(checks.shown);
}

TEST_CASE("an_empty_window_offers_to_open_a_model_and_writes_no_numbers_of_one") {
  PanelDriver d(workspace::Workspace{});
  CHECK_FALSE(d.says("Vertices, triangles"));
  CHECK(d.recorder().find("open_model")->enabled);
  CHECK_FALSE(d.recorder().find("open_cage")->enabled);
  CHECK_FALSE(d.has("save_model"));
  d.click("open_model");
  CHECK(d.workspace().files.browser.open);
  d.frame(3);
  CHECK(d.has("file_choose"));
  CHECK(d.says("No model. Open a model or drop a file on the window."));
}
