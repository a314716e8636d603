// Makes random actions. Undo and redo must restore the exact states.

#include <random>

#include "document/time_edit.h"
#include "support/commands.h"
#include "support/cube.h"
#include "support/edits.h"
#include "support/skip.h"
#include "workspace/command_tables.h"
#include "workspace/playing.h"
#include "workspace/pointer.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;
using namespace viete::workspace;

namespace {

// Makes random input with mouse, keys and commands, also during drags.
class RandomUser {
public:
  explicit RandomUser(unsigned seed) : random_(seed) {
    select_all_now_and_then();
    w.document.changed_history() = {};
  }

  Workspace w = test::cube_workspace();

  void act() {
    switch (below(16)) {
      case 13: return use_poses();
      case 14: return use_keys();
      case 15: return pass_time();
      case 11: return select_otherwise();
      case 12: return use_sets();
      case 10: return edit_probes();
      case 0: return click();
      case 1: return run_any_command();
      case 2: return select_all_now_and_then();
      case 3: return drag(below(2) == 0 ? middle_button : right_button, anywhere(), anywhere());
      case 4: return turn_wheel();
      case 5: return drag(left_button, anywhere(), anywhere());
      case 6: return drag(left_button, near_vertex(), anywhere());
      default: return use_gizmo();
    }
  }

private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  bool once_in(int n) { return below(n) == 0; }

  glm::vec2 anywhere() { return {200 + below(800), below(780)}; }
  glm::vec2 near_vertex() {
    const Projector project(w.document.space(), w.view.camera);
    const auto at = project(w.document.pose().positions[static_cast<std::size_t>(below(8))]);
    return at ? glm::vec2(*at) + glm::vec2(below(7) - 3, below(7) - 3) : anywhere();
  }

  void step() {
    pointer_.frame(w, input_);
    input_.escape = input_.enter = input_.backspace = false;
    input_.wheel = 0;
    input_.typed.clear();
  }
  void press_modifiers() {
    input_.shift = once_in(4);
    input_.ctrl = once_in(4);
    input_.alt = once_in(12);
  }
  void click() {
    press_modifiers();
    input_.position = once_in(2) ? near_vertex() : anywhere();
    step();
    input_.down[left_button] = true;
    step();
    input_.down[left_button] = false;
    step();
  }
  void turn_wheel() {
    input_.position = anywhere();
    input_.wheel = static_cast<float>(below(5) - 2);
    step();
  }
  void drag(int button, glm::vec2 from, glm::vec2 to) {
    press_modifiers();
    input_.position = from;
    step();
    input_.down[static_cast<std::size_t>(button)] = true;
    step();
    for (int i = 1; i <= 5; ++i) {
      input_.position = from + (to - from) * (static_cast<float>(i) / 5);
      disturb();
      step();
    }
    if (once_in(8)) cancel();
    input_.down = {};
    step();
  }
  void disturb() {
    static const std::string keys = "xyzXYZ0123456789.-";
    if (once_in(6)) input_.typed = keys[static_cast<std::size_t>(below(static_cast<int>(keys.size())))];
    if (once_in(20)) input_.backspace = true;
    if (once_in(15)) input_.wheel = static_cast<float>(below(7) - 3);
    if (once_in(20)) input_.enter = true;
    if (once_in(30)) input_.escape = true;
    if (once_in(10)) press_modifiers();
    if (once_in(30)) run_any_command();
  }
  void cancel() {
    if (once_in(2)) {
      input_.escape = true;
    } else {
      input_.down[right_button] = true;
    }
    step();
  }
  void use_gizmo() {
    const auto gizmo = gizmo_of(w);
    if (!gizmo) return select_all_now_and_then();
    const glm::vec2 ring(gizmo_view_ring, 0);
    const auto& arm = gizmo->arms[static_cast<std::size_t>(below(3))];
    const glm::vec2 from = w.view.tool == Tool::rotate ? gizmo->center + ring
                           : once_in(4)                ? gizmo->center
                                                       : arm.tip;
    drag(left_button, glm::round(from), from + glm::vec2(below(201) - 100, below(201) - 100));
  }
  void select_all_now_and_then() {
    test::run_command(w, once_in(3) ? "select_all" : "select_linked");
    static const char* const tools[] = {"tool_move", "tool_rotate", "tool_scale"};
    test::run_command(w, tools[below(3)]);
    w.view.options.cage = true;
  }
  void select_otherwise() {
    static const char* const shapes[] = {"select_box", "select_lasso", "select_brush"};
    test::run_command(w, shapes[below(3)]);
    drag(left_button, once_in(2) ? near_vertex() : anywhere(), anywhere());
    if (once_in(2)) test::run_command(w, "stop_selecting");
    static const char* const ways[] = {"select_more", "select_less", "hide_selected", "show_hidden",
                                       "invert_selection"};
    test::run_command(w, ways[below(5)]);
  }
  void use_sets() {
    auto& sets = w.document.changed_groups().sets;
    if (w.view.interaction.drag || sets.empty()) return void(test::run_command(w, "save_set"));
    const auto set = static_cast<std::size_t>(below(static_cast<int>(sets.size())));
    switch (below(4)) {
      case 0: return remove_set(w.document, set);
      case 1: return rename_set(w.document, set, "name " + std::to_string(below(5)));
      default: return select_set(w.document, set, static_cast<SelectMode>(below(3)));
    }
  }
  void edit_probes() {
    test::run_command(w, once_in(3) ? "add_probe" : "select_probes");
    test::run_command(w, "select_all");
    static const Part parts[] = {&Probe::turn, &Probe::stretch, &Probe::move};
    static constexpr double radii[] = {0.1, 0.7, 2};
    if (!w.view.interaction.drag && !w.document.selection().empty() &&
        w.document.selection().kind() == ElementKind::probe)
      set_radius(w.document, parts[below(3)], radii[below(3)]);
  }
  std::size_t any_of(std::size_t count) { return static_cast<std::size_t>(below(static_cast<int>(count))); }
  double percent(int least, int most) { return 0.01 * (least + below(most - least + 1)); }
  void use_poses() {
    Document& d = w.document;
    auto& poses = d.library().poses;
    if (is_dragging(w)) return;
    if (poses.size() < 2) return void(keep_pose(d, w.playback.vectors, "pose"));
    const std::size_t pose = any_of(poses.size());
    switch (below(11)) {
      case 0: return void(poses.size() < 9 ? keep_pose(d, w.playback.vectors, "pose") : 0);
      case 1: return rename_pose(d, pose, "name " + std::to_string(below(5)));
      case 2: return move_pose(d, pose, any_of(poses.size() + 1));
      case 3: return remove_pose(d, w.playback.vectors, pose);
      case 4: return update_pose(d, pose);
      case 5: return apply_pose(d, pose);
      case 6: return void(clear_mix(d, w.playback.vectors));
      default:
        for (int i = below(4); i >= 0; --i) set_weight(d, w.playback.vectors, pose, percent(-50, 150));
    }
  }
  void use_keys() {
    Document& d = w.document;
    if (is_dragging(w)) return;
    const auto frame = [this] { return below(40) - 5; };
    const auto& poses = d.library().poses;
    const std::size_t pose =
        poses.empty() ? 0 : static_cast<std::size_t>(below(static_cast<int>(poses.size())));
    const std::string channel = poses.empty() || once_in(2) ? "" : poses[pose].name;
    const KeyPlaces some = {{frame(), channel}, {frame(), channel}, {current_frame(d), channel}};
    switch (below(12)) {
      case 0: return set_camera_key(d, frame(), w.view.camera.pose());
      case 1: return remove_keys(d, some);
      case 2: return set_easing(d, some, static_cast<Easing>(below(3)));
      case 4:
        return set_play(d, {frame(), frame(), percent(0, 9999), static_cast<Repeat>(below(3)), once_in(2)});
      case 5: {
        const Timeline before = d.timeline();
        for (int i = below(4); i >= 0; --i)
          move_keys(d, before, some, std::vector{frame(), frame(), frame()});
        return;
      }
      case 3:
      case 7:
        if (poses.empty() || is_editing_cage(d)) return;
        return set_weight_key(d, pose, once_in(2) ? current_frame(d) : frame(), percent(-50, 150));
      case 6: return once_in(5) ? set_turntable(d, w.view.camera.pose()) : set_key(d, frame());
      default: return set_key(d, current_frame(d));
    }
  }
  void pass_time() {
    switch (below(8)) {
      case 0: w.playback.auto_key = !w.playback.auto_key; break;
      case 1: start_playing(w); break;
      case 2: stop_playing(w); break;
      case 3: go_to_key(w, once_in(2)); break;
      case 4: go_to_frame(w, 0.25 * (below(160) - 20)); break;
      default: follow_time(w, 0.1 * below(20));
    }
  }
  void run_any_command() {
    const auto all = commands();
    const Command& command = all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
    if (command.enabled(w)) command.run(w);
    w.jobs.wishes = {};
  }

  std::mt19937 random_;
  Pointer pointer_;
  PointerInput input_;
};

struct Everything {
  std::vector<mesh::Point> positions;
  std::vector<mesh::Vec3> turns;
  pose::Probes probes;
  Selection selection;
  CageGroups groups;
  PoseLibrary library;
  Timeline timeline;
  double frame;
  bool operator==(const Everything&) const = default;
};

// Ignores the element kind of an empty selection, because this kind is not part of the document.
Everything of(const Document& document) {
  const Selection& selection = document.selection();
  return {document.pose().positions, document.pose().turns,
          document.probes(),         selection.empty() ? Selection() : selection,
          document.groups(),         document.library(),
          document.timeline(),       document.frame()};
}

}  // namespace

TEST_CASE("thousands_of_random_actions_are_undone_to_the_last_bit_and_redone_as_well" *
          doctest::test_suite(test::longer)) {
  const auto persons = static_cast<unsigned>(test::rounds(3, 20));
  std::size_t edits = 0, poses = 0, keys = 0;
  for (unsigned seed = 1; seed <= persons; ++seed) {
    CAPTURE(seed);
    RandomUser person(seed);
    Document& document = person.w.document;
    const Everything start = of(document);
    for (int i = 0; i < 1000; ++i) person.act();
    const Everything end = of(document);
    for (const auto& p : document.pose().positions)
      for (const double x : p) REQUIRE(std::isfinite(x));
    for (const NamedPose& named : document.library().poses) REQUIRE(in_range(*named.pose));
    poses += document.library().poses.size();
    keys += document.timeline().keys.size();
    const std::size_t count = test::edit_count(document.history());
    edits += count;
    std::size_t steps = 0;
    for (; document.history().can_undo(); ++steps) undo(document);
    document.put_frame(start.frame);  // a change of the frame is not an edit
    CHECK(of(document) == start);
    CHECK_FALSE(differs_from_rest(document));
    for (std::size_t i = 0; i < steps; ++i) redo(document);
    CHECK(of(document) == end);
    CHECK(test::edit_count(document.history()) == count);
  }
  CHECK_MESSAGE(edits > 100 * persons, "the actions must reach the document: ", edits);
  CHECK_MESSAGE(poses > persons, "and its poses: ", poses);
  CHECK_MESSAGE(keys > persons, "and its keys: ", keys);
}
