// Sliders, fields, lists and notices with simulated events. Esc cancels active widgets and closes popups.
#include <imgui_internal.h>

#include "document/time_edit.h"
#include "ui/panel_driver.h"
#include "ui/widgets.h"

using namespace viete;
using test::PanelDriver;

namespace {

// Returns all data that sliders can change.
auto slid_state(const workspace::Workspace& w) {
  return std::tuple(w.document.deformer(), w.document.library(), w.document.timeline(),
                    w.document.pose().positions, w.document.pose().turns, w.document.probes(),
                    w.view.handling, w.preferences.layout, w.view.brush.radius, w.view.brush.share,
                    w.document.history().undo_label(), w.document.history().can_redo());
}

bool has_tooltip() {
  const ImGuiWindow* tooltip = ImGui::FindWindowByName("##Tooltip_00");
  return tooltip && tooltip->Active && !tooltip->Hidden;
}

struct Held : PanelDriver {
  Held() : PanelDriver(test::ball_workspace(2), {1440, 1000}) {
    document().changed_pose().positions[0][1] += 0.4;
    for (const char* section : {"Poses", "Probes"}) workspace().preferences.layout.sections[section] = true;
    workspace().preferences.layout.sections["Model"] = workspace().preferences.layout.sections["Display"] =
        false;
    for (const char* command : {"keep_pose", "reset_pose", "toggle_soft"}) run(command);
    document::set_key(document(), 1);
    document::set_key(document(), 20);
    workspace().preferences.layout.timeline = true;
    frame(3);
  }
  // Drags a widget and presses Esc. After that, all data must be as before, including the redo list.
  void check_called_off(const std::string& widget, glm::vec2 offset) {
    const glm::vec2 at = place_of(widget);
    const auto before = slid_state(workspace());
    press_and_move(at, at + offset);
    CHECK_MESSAGE(!(slid_state(workspace()) == before), widget, " does not move");
    CHECK_MESSAGE(!has_tooltip(), widget);
    press_key(workspace::Key::escape);
    CHECK_MESSAGE(slid_state(workspace()) == before, widget);
    move(at - offset);
    button(0, false);
    frame(2);
    CHECK_MESSAGE(slid_state(workspace()) == before, widget);
  }
  std::set<std::string> names() {
    std::set<std::string> all;
    for (const auto& [name, rect] : recorder().all()) all.insert(name);
    return all;
  }
};

}  // namespace

TEST_CASE("esc_cancels_any_slider_or_handle") {
  Held d;
  document::set_radius(d.document(), 0.3);
  document::undo(d.document());
  REQUIRE(d.document().history().can_redo());
  const glm::vec2 right{31, 0};
  for (const char* slider : {"rotation", "stretch", "pose_weight/0", "soft_radius"})
    d.check_called_off(slider, right);
  d.check_called_off("edge/methods", {-40, 0});
  d.check_called_off("edge/tools", {40, 0});
  d.run("toggle_arap");
  for (const char* slider : {"iterations", "attach", "hold"}) d.check_called_off(slider, right);
  d.run("tool_paint");
  for (const char* slider : {"brush_radius", "brush_share"}) d.check_called_off(slider, -right);
  d.run("tool_move");
  d.run("add_probe");
  d.check_called_off("probe_turn_radius", right);
}

TEST_CASE("a_double_click_or_ctrl_click_on_a_slider_types_its_number_within_its_range") {
  Held d;
  d.run("toggle_timeline");  // makes the columns higher
  const auto begin = [&](const std::string& slider, bool twice) {
    d.place_of(slider);  // scrolls to the slider
    const auto rect = d.recorder().find(slider);
    const glm::vec2 at{rect->x0 + 0.9f * (rect->x1 - rect->x0), 0.5f * (rect->y0 + rect->y1)};
    const auto before = slid_state(d.workspace());
    d.frame(30);  // so that the next click is not a double click
    if (twice) {
      d.click(at);
      d.click(at);
    } else {
      d.key(PanelDriver::left_ctrl, true);
      d.click(at);
      d.key(PanelDriver::left_ctrl, false);
    }
    d.frame(3);
    CHECK_MESSAGE(slid_state(d.workspace()) == before, slider, " has jumped");
  };
  const auto type = [&](const std::string& slider, const std::string& text, bool twice = true) {
    CAPTURE(slider);
    begin(slider, twice);
    const interact::Tool tool = d.workspace().view.tool;
    const auto kind = d.document().selection().kind();
    const auto method = d.document().method();
    for (const char c : text) {
      if (c != '.') d.key(c, true);
      d.type(std::string(1, c));
      if (c != '.') d.key(c, false);
    }
    d.press_key(workspace::Key::enter);
    CHECK(d.workspace().view.tool == tool);
    CHECK(d.document().selection().kind() == kind);
    CHECK(d.document().method() == method);
    CHECK(d.workspace().panels.typed_slider.name.empty());
  };
  auto& deformer = d.document().deformer();
  const auto pose_weight = [&] { return d.document().library().poses[0].weight; };
  auto& w = d.workspace();
  const double diagonal = d.document().space().diagonal();
  const struct {
    const char* command;  // if not empty, runs first
    const char *slider, *text;
    std::function<double()> value;
    double expected;
    bool twice = true;
  } cases[] = {
      {"", "rotation", "33", [&] { return deformer.amounts.rotation; }, 0.33},
      {"", "stretch", "1000", [&] { return deformer.amounts.stretch; }, pose::number("stretch").largest},
      {"", "pose_weight/0", "12.5", pose_weight, 0.125},
      {"", "pose_weight/0", "999", pose_weight, document::PoseLibrary::largest_weight, false},
      {"", "soft_radius", "0.5", [&] { return w.view.handling.soft.radius; }, 0.5 / diagonal},
      {"toggle_arap", "iterations", "7", [&] { return double(deformer.iterations); }, 7},
      {"", "attach", "4", [&] { return deformer.holding.radius; }, 0.04},
      {"", "hold", "500", [&] { return deformer.holding.weight; }, 1},
      {"tool_paint", "brush_radius", "77", [&] { return double(w.view.brush.radius); }, 77},
      {"", "brush_share", "35", [&] { return double(w.view.brush.share); }, 0.35, false}};
  for (const auto& c : cases) {
    if (*c.command) d.run(c.command);
    type(c.slider, c.text, c.twice);
    CHECK(c.value() == doctest::Approx(c.expected));
  }
  d.run("tool_move");
  d.run("add_probe");
  type("probe_turn_radius", "21");
  CHECK(d.document().probes().all[0].turn.radius == doctest::Approx(0.21 * diagonal));

  // Esc keeps the old number. After that, a click moves the slider.
  const auto before = slid_state(d.workspace());
  begin("rotation", true);
  d.type("150");
  d.press_key(workspace::Key::escape);
  CHECK(slid_state(d.workspace()) == before);
  CHECK(d.workspace().panels.typed_slider.name.empty());
  d.frame(30);
  d.click("rotation");
  CHECK(deformer.amounts.rotation == doctest::Approx(1));
}

TEST_CASE("no_hint_of_a_panel_lies_over_a_dialog_and_the_dialog_has_its_own") {
  Held d;
  for (const char* dialog : {"open_model", "command_palette", "help", "show_messages"}) {
    CAPTURE(dialog);
    d.move(d.place_of("keep_pose"));
    d.frame(3);
    REQUIRE(has_tooltip());
    d.run(dialog);
    CHECK_FALSE(has_tooltip());
    if (std::string_view(dialog) == "open_model") {
      d.move(d.place_of("file_up"));
      d.frame(3);
      CHECK(has_tooltip());
    }
    d.press_key(workspace::Key::escape);
  }
}

TEST_CASE("fields_of_places_show_as_many_digits_as_there_is_room_for") {
  Held d;
  d.workspace().preferences.layout.sections["Cage"] = true;
  d.document().changed_selection().apply(std::vector<std::uint32_t>{0}, document::SelectMode::replace);
  for (const double x : {-0.0036471234, -123.456789, -1.23456789e-5, 0.5}) {
    CAPTURE(x);
    d.document().changed_pose().positions[0][0] = x;
    d.frame(3);
    d.click("transform_x");
    const std::string text = d.workspace().panels.typed.at("transform_x").text;
    const auto rect = d.recorder().find("transform_x");
    CHECK(ImGui::CalcTextSize(text.c_str()).x <=
          rect->x1 - rect->x0 - 2 * ImGui::GetStyle().FramePadding.x + 0.01f);
    CHECK(std::stod(text) == doctest::Approx(x).epsilon(0.05));
    d.press_key(workspace::Key::escape);
  }
}

TEST_CASE("esc_closes_popups_without_a_change") {
  Held d;
  d.workspace().preferences.layout.sections["Display"] =
      true;  // below the probes, so that the column must scroll
  d.run("add_probe");
  for (const char* chooser :
       {"deformer", "weights", "blend", "pivot", "axes", "mirror", "soft_curve", "soft_distance", "probe_mix",
        "probe_turn", "time/repeat", "time/easing", "menu/File", "menu/View"}) {
    const bool in_bar = std::string_view(chooser).starts_with("menu/");  // the menu bar does not scroll
    const auto rect = d.recorder().find(chooser);
    const glm::vec2 place = in_bar ? glm::vec2(rect.value().x0 + 4, rect->y0 + 4) : d.place_of(chooser);
    d.frame(2);
    const std::set<std::string> closed = d.names();
    const auto before = slid_state(d.workspace());
    d.click(place);
    CHECK_MESSAGE(d.names().size() > closed.size(), chooser);
    d.press_key(workspace::Key::escape);
    CHECK_MESSAGE(d.names() == closed, std::string(chooser));
    CHECK_MESSAGE(slid_state(d.workspace()) == before, chooser);
  }
}

TEST_CASE("esc_in_a_field_leaves_its_number_and_name") {
  Held d;
  for (const char* field : {"pose_weight/0/typed", "pose_name/0", "time/frame", "time/rate", "time/last"}) {
    const auto before = slid_state(d.workspace());
    d.click(field);
    d.type("77");
    d.press_key(workspace::Key::escape);
    CHECK_MESSAGE(slid_state(d.workspace()) == before, field);
  }
}

TEST_CASE("methods_timings_and_deformer_are_visible_at_the_first_start_without_a_click") {
  for (const auto& [size, scale] :
       {std::pair{glm::ivec2(1440, 900), 1.0f}, std::pair{glm::ivec2(512, 320), 2.0f}}) {
    PanelDriver d(test::ball_workspace(2), size, scale);
    d.document().changed_pose().positions[0][1] += 0.4;
    d.workspace().preferences.layout.sections.clear();
    d.frame(3);
    const auto& recorder = d.recorder();
    std::vector<std::string> always{"method_diag", "method_sd", "method_improved_sd", "method_fast"};
    if (scale == 1)
      always.insert(always.end(),
                    {"timings/Diag", "timings/Fast", "timings/fused", "errors", "deformer", "rotation"});
    for (const std::string& widget : always) {
      CAPTURE(widget);
      REQUIRE(recorder.find(widget));
      CHECK(recorder.find(widget)->visible);
    }
    CHECK_FALSE(recorder.find("weights"));
    // If all sections are folded, the left column has at most 20 controls.
    std::size_t controls = 0;
    for (const auto& [name, rect] : recorder.all())
      controls += rect.x1 <= d.workspace().view.camera.viewport.origin.x && !name.starts_with("menu/");
    CHECK(controls <= 20);
  }
}

TEST_CASE("the_first_start_asks_once_for_the_keymap") {
  for (const bool chooses : {true, false}) {
    PanelDriver d(test::ball_workspace(2), {1024, 640});
    CHECK_FALSE(d.recorder().find("ask_keys/blender"));
    d.workspace().panels.ask_keys = d.workspace().preferences.ask_keys = true;
    d.workspace().view.options.hints = false;  // after the first transform
    d.frame(3);
    CHECK(d.workspace().preferences.ask_keys);
    d.click(chooses ? "ask_keys/blender" : "ask_keys/close");
    CHECK(d.workspace().preferences.keymap.preset() ==
          (chooses ? workspace::KeyPreset::blender : workspace::KeyPreset::viete));
    CHECK_FALSE(d.recorder().find("ask_keys/blender"));
    CHECK_FALSE(d.workspace().preferences.ask_keys);
  }
}

TEST_CASE("notices_are_whole_and_cover_no_tool") {
  for (const glm::ivec2 size : {glm::ivec2(1024, 640), glm::ivec2(1440, 900)}) {
    PanelDriver d(test::ball_workspace(2), size);
    workspace::Workspace& w = d.workspace();
    std::string text = "A warning that is so long that six lines do not hold it:";
    for (int i = 0; i < 160; ++i) text += " w\u00f6rter " + std::to_string(i);
    w.messages.warn(text);
    d.frame(5);
    const auto tool = d.recorder().find("strip/tool_move");
    REQUIRE(tool);
    const auto rect = d.recorder().find("toast/0");
    REQUIRE(rect);
    CHECK(rect->x0 >= tool->x1);
    CHECK(rect->x1 <= w.view.camera.viewport.origin.x + w.view.camera.viewport.size.x);
    CHECK(rect->y1 - rect->y0 < 140);  // at most six lines
  }
}

TEST_CASE("a_tooltip_does_not_cover_its_widget") {
  Held d;
  for (const char* section : {"Analysis", "Views", "Model"})
    d.workspace().preferences.layout.sections[section] = true;
  std::string words;
  for (int i = 0; i < 60; ++i) words += "several lines ";
  d.workspace().messages.warn(words);
  d.frame(4);
  for (const char* widget : {"views_4", "toast/0"}) {
    d.move(d.place_of(widget));
    d.frame(4);
    REQUIRE_MESSAGE(has_tooltip(), widget);
    const auto rect = d.recorder().find(widget);
    const ImGuiWindow* tooltip = ImGui::FindWindowByName("##Tooltip_00");
    CHECK_MESSAGE((tooltip->Pos.y >= rect->y1 || tooltip->Pos.y + tooltip->Size.y <= rect->y0), widget);
    CHECK(tooltip->Pos.x + tooltip->Size.x <= 1440.5f);
  }
}

TEST_CASE("a_right_click_on_a_pose_opens_its_menu") {
  Held d;
  d.workspace().view.chosen_pose.reset();
  d.click(d.place_of("pose_name/0"), 1);
  d.frame(2);
  CHECK(d.workspace().view.chosen_pose == std::size_t{0});
  d.click("menu/remove_pose");
  CHECK(d.document().library().poses.empty());
}

TEST_CASE("arrow_keys_and_enter_choose_in_every_list") {
  Held d;
  for (const char* section : {"Analysis", "Map"}) d.workspace().preferences.layout.sections[section] = true;
  d.frame(2);
  const auto by_key = [&](const char* chooser, workspace::Key arrow) {
    d.click(chooser);
    d.frame(2);
    d.press_key(arrow);
    d.press_key(workspace::Key::enter);
    d.frame(2);
    CHECK_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
  };
  by_key("map", workspace::Key::down);
  CHECK(d.workspace().view.options.field == static_cast<analysis::Field>(1));
  by_key("map", workspace::Key::up);
  CHECK(d.workspace().view.options.field == analysis::Field::none);
  by_key("deformer", workspace::Key::down);
  CHECK(pose::preset_of(d.document().deformer()) == pose::Preset::mean_value);
}

TEST_CASE("the_summary_of_checks_counts_problems_and_notes_apart") {
  workspace::CheckState checks;
  CHECK(ui::checks_summary(checks, 0) == "no problems");
  checks.findings.resize(2);  // open edges of the model
  checks.findings[0].subject = document::Subject::cage;
  CHECK(ui::checks_summary(checks, 0) == "1 problem, 1 note");
  CHECK(ui::checks_summary(checks, 1) == "2 problems, 1 note");
}

TEST_CASE("errors_say_nan_and_exact_zero") {
  CHECK(ui::error(0) == "0");
  CHECK(ui::error(3.14e-16) == "3.1e-16");
  CHECK(ui::error(std::nan("")) == "NaN");
}
