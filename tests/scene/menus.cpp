#include "scene/workspace/menus.h"

#include <doctest/doctest.h>

#include <set>

#include "scene/workspace/workspace.h"

using namespace viete;
using namespace viete::scene;

TEST_CASE("every_command_stands_in_one_menu") {
  std::size_t count = 0;
  std::set<std::string_view> names;
  for (const Menu& menu : menus()) {
    CHECK_FALSE(menu.items.empty());
    for (const Command* command : menu.items) ++count, names.insert(command->name);
  }
  CHECK(count == commands().size());
  CHECK(names.size() == commands().size());
}

TEST_CASE("every_command_is_understood_by_its_label_alone") {
  std::set<std::string_view> labels;
  const std::set<std::string_view> plain = {"Undo", "Redo", "Quit", "Play"};
  for (const Command& command : commands()) {
    const std::string_view label = command.label;
    CHECK_MESSAGE(labels.insert(label).second, label);
    CHECK_MESSAGE((label.find(' ') != label.npos || plain.contains(label)), label);
    CHECK_FALSE(command.brief.empty());
    if (command.submenu.empty()) continue;
    CHECK_MESSAGE(label.size() > command.brief.size(), label);  // its headline, too
  }
}

TEST_CASE("commands_of_one_choice_follow_one_another_in_their_menu") {
  for (const Menu& menu : menus()) {
    std::set<std::string_view> ended;
    std::string_view now;
    for (const Command* command : menu.items) {
      const auto submenu = command->submenu;
      if (submenu == now) continue;
      if (!now.empty()) ended.insert(now);
      now = submenu;
      CHECK_MESSAGE(!ended.contains(submenu), submenu);
    }
  }
}

TEST_CASE("a_few_letters_find_a_command_and_the_best_comes_first") {
  const Workspace w;
  CHECK(find_commands(w, "wire").front()->name == "toggle_wireframe");
  CHECK(find_commands(w, "WIREF").front()->name == "toggle_wireframe");
  CHECK(find_commands(w, "undo").front()->name == "undo");
  CHECK(find_commands(w, "frsl").front()->name == "frame_selection");
  CHECK(find_commands(w, "sel inv").front()->name == "invert_selection");
  CHECK(find_commands(w, "no such thing at all").empty());
}

TEST_CASE("nothing_typed_finds_all_but_what_answers_something_that_is_not_there") {
  const Workspace w;
  const auto all = find_commands(w, "");
  CHECK(all.size() > 80);
  for (const Command* command : all) CHECK_FALSE(command->passing);
}

TEST_CASE("a_switch_says_whether_it_is_on") {
  Workspace w;
  CHECK(find_command("toggle_grid")->on(w));
  w.view.grid = false;
  CHECK_FALSE(find_command("toggle_grid")->on(w));
  CHECK_FALSE(bool(find_command("undo")->is_on));
}
