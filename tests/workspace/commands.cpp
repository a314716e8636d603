#include "workspace/command.h"

#include <cctype>
#include <set>
#include <sstream>

#include "support/commands.h"
#include "support/cube.h"
#include "support/edits.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;

TEST_CASE("names_and_shortcuts_are_unique_and_every_command_has_a_hint") {
  std::set<std::string> names;
  std::multimap<std::string, std::string_view> keys;
  for (const auto& command : commands()) {
    CHECK(names.insert(std::string(command.name)).second);
    CHECK_FALSE(command.hint.empty());
    for (const auto& shortcut : {command.shortcut, command.alternative}) {
      if (shortcut.key == Key::none) continue;
      const auto [first, last] = keys.equal_range(text(shortcut));
      for (auto other = first; other != last; ++other)
        CHECK_MESSAGE(shares_keys(other->second, command.name), other->second, " and ", command.name);
      keys.emplace(text(shortcut), command.name);
    }
  }
}

TEST_CASE("no_menu_has_more_than_eight_items_without_a_separator") {
  for (const Menu& menu : menus()) {
    std::size_t run = 0;
    std::string_view group, submenu;
    for (const Command* command : menu.items) {
      const bool inside = !command->submenu.empty() && command->submenu == submenu;  // of one submenu
      run = command->group != group || begins_section(*command) ? 1 : run + !inside;
      group = command->group;
      submenu = command->submenu;
      CHECK_MESSAGE(run <= 8, menu.title, ": ", command->name);
    }
  }
}

TEST_CASE("an_unknown_command_is_not_found_a_disabled_one_does_nothing_and_a_toggle_is_on_or_off") {
  Workspace empty;
  for (const bool on : {true, false}) {
    CHECK(find_command("toggle_grid")->on(empty) == on);
    empty.view.options.grid = false;
  }
  CHECK(find_command("no_such") == nullptr);
  CHECK_FALSE(test::run_command(empty, "undo"));
  CHECK_FALSE(test::run_command(empty, "reset_pose"));
}

TEST_CASE(
    "whatever_command_runs_first_an_empty_window_stays_empty_and_a_cage_is_as_it_was_once_all_is_taken_"
    "back") {
  const pose::Pose rest = test::cube_workspace().document.pose();
  for (const auto& command : commands()) {
    CAPTURE(command.name);
    Workspace empty, w = test::cube_workspace();
    test::run_command(empty, command.name);
    CHECK_FALSE(empty.document.model().surface);
    CHECK_FALSE(empty.document.has_cage());
    test::run_command(w, command.name);
    while (test::run_command(w, "undo")) {
    }
    CHECK(w.document.pose().positions == rest.positions);
    CHECK_FALSE(differs_from_rest(w.document));
  }
}

TEST_CASE("undo_and_redo_name_their_step_and_any_edit_of_the_history_can_be_gone_to") {
  Workspace w = test::cube_workspace();
  const Command &undo = *find_command("undo"), &redo = *find_command("redo");
  CHECK(undo.label_now(w) == "Undo");
  const auto rest = w.document.pose().positions;
  for (int i = 1; i <= 3; ++i) {
    record_edit(w.document, "move " + std::to_string(i));
    w.document.changed_pose().positions[0][0] = 10 * i;
  }
  CHECK(undo.label_now(w) == "Undo Move 3");
  CHECK(redo.label_now(w) == "Redo");
  CHECK(test::run_command(w, "undo"));
  CHECK(undo.label_now(w) == "Undo Move 2");
  CHECK(redo.label_now(w) == "Redo Move 3");
  for (const std::size_t edits : {3u, 1u, 0u, 2u}) {
    go_to_edit(w.document, edits);
    CHECK(w.document.history().position() == edits);
    CHECK(w.document.pose().positions[0][0] == (edits > 0 ? 10.0 * static_cast<double>(edits) : rest[0][0]));
  }
}

TEST_CASE("methods_switch_without_touching_history_pose_or_weights") {
  Workspace w = test::cube_workspace();
  const Revisions before = w.document.revisions();
  CHECK(test::run_command(w, "method_sd"));
  CHECK(w.document.method() == sym3::Method::sd);
  CHECK(w.document.revisions().method > before.method);
  CHECK(w.document.revisions().pose == before.pose);
  CHECK(w.document.revisions().weights == before.weights);
  CHECK_FALSE(w.document.history().can_undo());
}

TEST_CASE("ways_of_blending_are_commands_that_can_be_taken_back") {
  Workspace w = test::cube_workspace();
  w.document.put_deformer({});
  const Revisions before = w.document.revisions();
  CHECK(test::run_command(w, "blend_linear"));
  CHECK(w.document.deformer().blend == pose::Blend::linear);
  CHECK(w.document.revisions().weights == before.weights);
  CHECK(w.document.revisions().method > before.method);
  CHECK_FALSE(test::run_command(w, "method_sd"));
  CHECK(test::run_command(w, "weights_mean_value"));
  CHECK(w.document.deformer().weighting.weights == pose::Weights::mean_value);
  CHECK(w.document.revisions().weights > before.weights);
  CHECK(w.document.revisions().surfaces == before.surfaces);
  CHECK(test::edit_count(w.document.history()) == 2);
  CHECK(test::run_command(w, "weights_mean_value"));
  CHECK(test::edit_count(w.document.history()) == 2);
  CHECK(test::run_command(w, "undo"));
  CHECK(w.document.deformer().blend == pose::Blend::linear);
  CHECK(w.document.deformer().weighting.weights == pose::Weights::inverse);
  CHECK(test::run_command(w, "undo"));
  CHECK(w.document.deformer() == pose::Deformer());
  CHECK(test::run_command(w, "redo"));
  CHECK(w.document.deformer().blend == pose::Blend::linear);
}

TEST_CASE("amounts_that_slide_are_one_edit_and_stay_with_other_choices") {
  Workspace w = test::cube_workspace();
  for (const double turn : {0.9, 0.5, 0.25}) set_amounts(w.document, {turn, 1});
  set_amounts(w.document, {0.25, 1});  // changes nothing
  CHECK(test::edit_count(w.document.history()) == 1);
  set_radius(w.document, 0.3);
  set_amounts(w.document, {0.25, 2});
  CHECK(test::edit_count(w.document.history()) == 3);
  CHECK(test::run_command(w, "blend_linear"));
  CHECK(w.document.deformer().amounts == pose::Amounts{0.25, 2});
  for (int n = 0; n < 4; ++n) CHECK(test::run_command(w, "undo"));
  CHECK(w.document.deformer().amounts.whole());
  CHECK(test::run_command(w, "redo"));
  CHECK(w.document.deformer().amounts == pose::Amounts{0.25, 1});
}

TEST_CASE("stitching_is_an_edit_where_elements_have_maps_and_numbers_chosen_in_a_row_are_one") {
  Workspace w = test::cube_workspace();
  const Revisions before = w.document.revisions();
  CHECK(test::run_command(w, "toggle_arap"));
  CHECK(w.document.deformer().iterations == 1);
  CHECK(w.document.revisions().method > before.method);
  CHECK(w.document.revisions().weights == before.weights);
  for (const int iterations : {3, 4, 7}) set_iterations(w.document, iterations);
  CHECK(w.document.deformer().iterations == 7);
  CHECK(test::edit_count(w.document.history()) == 1);
  CHECK(test::run_command(w, "undo"));
  CHECK_FALSE(w.document.deformer().stitched());
  CHECK(test::run_command(w, "redo"));
  CHECK(w.document.deformer().iterations == 7);
  CHECK(test::run_command(w, "weights_harmonic"));  // stitching stays on
  CHECK(w.document.deformer().iterations == 7);
  CHECK(test::run_command(w, "weights_mean_value"));  // these weights do not support stitching
  CHECK_FALSE(w.document.deformer().stitched());
  CHECK_FALSE(test::run_command(w, "toggle_arap"));
  CHECK(test::run_command(w, "undo"));
  CHECK(w.document.deformer().iterations == 7);
  // Consecutive changes of the constraints form one edit. While stitching is off, the constraints are kept.
  const auto edits = test::edit_count(w.document.history());
  for (const double radius : {0.01, 0.05, 0.1}) set_holding(w.document, {radius, 0});
  CHECK(test::edit_count(w.document.history()) == edits + 1);
  CHECK(test::run_command(w, "toggle_arap"));
  CHECK_FALSE(w.document.deformer().stitched());
  CHECK(w.document.deformer().holding.radius == 0.1);
}

TEST_CASE("a_failed_deformer_leaves_no_history_entry") {
  Workspace w = test::cube_workspace();
  test::run_command(w, "reset_pose");
  const std::size_t edits = test::edit_count(w.document.history());
  test::run_command(w, "weights_mean_value");
  revert_deformer(w.document, pose::Deformer());
  CHECK(w.document.deformer() == pose::Deformer());
  CHECK(test::edit_count(w.document.history()) == edits);
  w.document.changed_pose().positions[0][0] += 0.25;
  test::run_command(w, "weights_mean_value");
  test::run_command(w, "reset_pose");
  revert_deformer(w.document,
                  pose::Deformer());  // keeps both edits: the last edit did not change the deformer
  CHECK(test::edit_count(w.document.history()) == edits + 2);
  CHECK(w.document.deformer() == pose::Deformer());
}

TEST_CASE("all_none_invert_and_linked_work_on_the_chosen_kind") {
  Workspace w = test::cube_workspace();
  for (const auto& [name, count] :
       {std::pair{"select_vertices", 8u}, {"select_edges", 18u}, {"select_faces", 12u}}) {
    CHECK(test::run_command(w, name));
    CHECK(test::run_command(w, "select_all"));
    CHECK(w.document.selection().size() == count);
    CHECK(test::run_command(w, "invert_selection"));
    CHECK(w.document.selection().empty());
    CHECK_FALSE(test::run_command(w, "select_linked"));
    w.view.interaction.hovered = 3;
    CHECK(test::run_command(w, "select_linked"));
    CHECK(w.document.selection().size() == count);
    CHECK(test::run_command(w, "select_none"));
    w.view.interaction.hovered.reset();
  }
}

TEST_CASE("a_command_that_cannot_run_says_what_to_do_first") {
  const Workspace nothing_open;
  for (const auto& command : commands()) {
    CAPTURE(command.name);
    if (!command.enabled(nothing_open)) CHECK(command.enabled.otherwise.ends_with('.'));
  }
  CHECK(find_command("save_pose")->enabled.otherwise == "Open a cage first.");
}

TEST_CASE("every_command_stands_in_one_menu") {
  std::size_t count = 0;
  std::set<std::string_view> names;
  for (const Menu& menu : menus()) {
    CHECK_FALSE(menu.items.empty());
    for (const Command* command : menu.items) {
      ++count;
      names.insert(command->name);
    }
  }
  CHECK(count == commands().size());
  CHECK(names.size() == commands().size());
}

TEST_CASE("every_command_is_understood_by_its_label_alone") {
  std::set<std::string_view> labels;
  const std::set<std::string_view> plain = {"Undo", "Redo", "Quit", "Preferences", "Play"};
  for (const Command& command : commands()) {
    const std::string_view label = command.label;
    CHECK_MESSAGE(labels.insert(label).second, label);
    CHECK_MESSAGE((label.find(' ') != label.npos || plain.contains(label)), label);
    CHECK_FALSE(command.brief.empty());
    if (command.submenu.empty()) continue;
    CHECK_MESSAGE(label.size() > command.brief.size(), label);  // the label begins with the submenu's title
  }
}

// The first letters of each word: "Lock probes" and "Locked" have the stem "lock" in common.
static std::set<std::string> stems(std::string label) {
  std::ranges::transform(label, label.begin(), [](unsigned char c) {
    return std::isalpha(c) ? static_cast<char>(std::tolower(c)) : ' ';
  });
  std::set<std::string> all;
  std::istringstream words(label);
  for (std::string word; words >> word;) all.insert(word.substr(0, 4));
  return all;
}

TEST_CASE("a_short_label_has_the_words_of_the_full_label") {
  const std::set<std::string_view> answers = {"Done", "Not now", "None", "Open this cage"};
  for (const Command& command : commands())
    if (!answers.contains(command.brief))
      CHECK_MESSAGE(std::ranges::includes(stems(command.label), stems(command.brief)), command.name);
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
  const auto all = find_commands(w, "");
  CHECK(all.size() > 80);
  for (const Command* command : all) CHECK_FALSE(command->passing);
}
