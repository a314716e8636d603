#include "scene/commands.h"

#include <doctest/doctest.h>

#include <set>

#include "scene/cube.h"
#include "scene/edit.h"

using namespace viete;
using namespace viete::scene;

TEST_CASE("names_and_shortcuts_are_unique_and_every_command_has_a_hint") {
  std::set<std::string> names, keys;
  for (const auto& command : commands()) {
    CHECK(names.insert(std::string(command.name)).second);
    CHECK_FALSE(command.hint.empty());
    for (const auto& shortcut : {command.shortcut, command.alternative}) {
      if (shortcut.key != Key::none) CHECK_MESSAGE(keys.insert(text(shortcut)).second, text(shortcut));
    }
  }
}

TEST_CASE("an_unknown_command_is_a_bug_and_a_disabled_one_does_nothing") {
  Workspace empty;
  CHECK_THROWS_AS(run_command(empty, "no_such"), std::logic_error);
  CHECK_FALSE(run_command(empty, "undo"));
  CHECK_FALSE(run_command(empty, "reset_pose"));
}

TEST_CASE("every_command_can_run_in_any_state_without_harm") {
  for (const bool with_document : {false, true}) {
    for (const auto& command : commands()) {
      Workspace w = with_document ? test::cube_workspace() : Workspace{};
      run_command(w, command.name);
    }
  }
}

TEST_CASE("reset_pose_can_be_undone") {
  Workspace w = test::cube_workspace();
  w.document.pose.positions[3][1] += 0.25;
  const auto posed = w.document.pose.positions;
  CHECK(run_command(w, "reset_pose"));
  CHECK_FALSE(differs_from_rest(w.document));
  CHECK(run_command(w, "undo"));
  CHECK(w.document.pose.positions == posed);
  CHECK(run_command(w, "redo"));
  CHECK_FALSE(differs_from_rest(w.document));
}

TEST_CASE("methods_switch_without_touching_the_history") {
  Workspace w = test::cube_workspace();
  const auto posed = w.document.posed;
  CHECK(run_command(w, "method_sd"));
  CHECK(w.document.method == sym3::Method::sd);
  CHECK(w.document.posed > posed);
  CHECK_FALSE(w.document.history.can_undo());
}

TEST_CASE("shortcuts_read_as_on_the_keyboard") {
  CHECK(text(find_command("redo")->shortcut) == "Ctrl+Shift+Z");
  CHECK(text(find_command("frame_all")->shortcut) == "Home");
  CHECK(text(find_command("frame_selection")->shortcut) == "F");
}

TEST_CASE("all_none_invert_and_linked_work_on_the_chosen_kind") {
  Workspace w = test::cube_workspace();
  for (const auto& [name, count] :
       {std::pair{"select_vertices", 8u}, {"select_edges", 18u}, {"select_faces", 12u}}) {
    CHECK(run_command(w, name));
    CHECK(run_command(w, "select_all"));
    CHECK(w.document.selection.size() == count);
    CHECK(run_command(w, "invert_selection"));
    CHECK(w.document.selection.empty());
    CHECK_FALSE(run_command(w, "select_linked"));
    w.hand.hovered = 3;
    CHECK(run_command(w, "select_linked"));
    CHECK(w.document.selection.size() == count);
    CHECK(run_command(w, "select_none"));
    w.hand.hovered.reset();
  }
}

TEST_CASE("tools_and_the_camera_are_switched_by_commands") {
  Workspace w;
  for (const auto& [name, tool] : {std::pair{"tool_rotate", Tool::rotate},
                                   {"tool_scale", Tool::scale},
                                   {"tool_select", Tool::select},
                                   {"tool_move", Tool::move}}) {
    CHECK(run_command(w, name));
    CHECK(w.tool == tool);
  }
  CHECK(run_command(w, "toggle_orthographic"));
  CHECK(w.camera.pose().orthographic);
  CHECK(run_command(w, "toggle_orthographic"));
  CHECK_FALSE(w.camera.pose().orthographic);
}

TEST_CASE("a_command_that_cannot_run_says_what_to_do_first") {
  const Workspace nothing_open;
  for (const auto& command : commands()) {
    CAPTURE(command.name);
    if (!command.enabled(nothing_open)) CHECK(command.enabled.otherwise.ends_with('.'));
  }
  CHECK(find_command("save_pose")->enabled.otherwise == "Open a cage first.");
}
