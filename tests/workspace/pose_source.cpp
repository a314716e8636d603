// The source of the shown pose after each transition.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "document/cage_editing.h"
#include "document/pose_edit.h"
#include "document/probes.h"
#include "document/time_edit.h"
#include "support/posed_cube.h"
#include "workspace/command.h"
#include "workspace/open_save.h"
#include "workspace/playing.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;
using Kind = PoseSource::Kind;

namespace {

// A cube with two named poses, and keys at the frames 1, 11 and 31. A weight can have keys, too.
struct Scene {
  Workspace w = test::cube_workspace();

  explicit Scene(Kind kind, bool keyed_weight = false) {
    w.document.changed_timeline() = test::three_keys();
    test::add_two_poses(w.document);
    if (keyed_weight)
      w.document.changed_timeline().channels = {
          {"wide", w.document.library().poses[1].pose, {{1, 0}, {11, 0.5}}}};
    follow_time(w, 0);
    go_to(6);
    if (kind == Kind::edited) drag();
    if (kind == Kind::mix) apply();
    if (kind == Kind::pins) pull_pin();
    if (kind == Kind::rest) {
      drag();
      press_tab();
    }
    REQUIRE(source() == kind);
  }
  Kind source() const { return source_of(w.document); }
  void play() {
    start_playing(w);
    follow_time(w, 0.1);
  }
  void drag() {
    record_edit(w.document, "move");
    w.document.changed_pose().positions[0][0] -= 0.25;
    follow_time(w, 0);
  }
  void weigh() {
    change_mix(w, [&] { return set_weight(w.document, w.playback.vectors, 0, 0.5); });
    follow_time(w, 0);
  }
  void set_key() {
    document::set_key(w.document, current_frame(w.document));
    follow_time(w, 0);
  }
  void key_weight() {
    w.panels.hovered_weight = 1;
    find_command("set_key")->run(w);
    follow_time(w, 0);
  }
  void press_tab() {
    is_editing_cage(w.document) ? end_cage_editing(w.document) : begin_cage_editing(w.document);
    follow_time(w, 0);
  }
  void go_to(double frame) {
    go_to_frame(w, frame);
    follow_time(w, 0);
  }
  void apply() {
    workspace::apply_pose(w, 1);
    follow_time(w, 0);
  }
  void pull_pin() {
    REQUIRE(add_pin(w.document, {}, w.document.model().surface->positions[7]));
    follow_pins(w);
    record_edit(w.document, "move a pin");
    w.document.changed_probes().all[0].pose.move = {0.1, 0, 0};
    int frames = 0;
    do follow_pins(w);
    while (w.frame.pins.is_due() && ++frames < 100);
  }
  void take_back() {
    undo(w.document);
    follow_time(w, 0);
  }
};

struct Transition {
  const char* name;
  void (Scene::*act)();
  Kind edited, frame, mix, pins, rest;  // the source after the transition, by the source before it
  bool undoable = true;

  Kind after(Kind before) const {
    switch (before) {
      case Kind::edited: return edited;
      case Kind::frame: return frame;
      case Kind::mix: return mix;
      case Kind::pins: return pins;
      case Kind::rest: return rest;
    }
    return before;
  }
};

constexpr Kind by_edit = Kind::edited, by_frame = Kind::frame, by_mix = Kind::mix, by_pins = Kind::pins,
               at_rest = Kind::rest;

// Cage editing refuses the timeline. An edited pose is still unkeyed after a weight is keyed. A keyed mix is
// still a mix. A weight or a named pose ends cage editing.
const Transition transitions[] = {
    {"play", &Scene::play, by_frame, by_frame, by_frame, by_frame, at_rest, false},
    {"drag", &Scene::drag, by_edit, by_edit, by_edit, by_edit, at_rest},
    {"move a slider of a weight", &Scene::weigh, by_mix, by_mix, by_mix, by_mix, by_mix},
    {"apply a named pose", &Scene::apply, by_mix, by_mix, by_mix, by_mix, by_mix},
    {"set a key", &Scene::set_key, by_frame, by_frame, by_mix, by_frame, at_rest},
    {"key a weight", &Scene::key_weight, by_edit, by_frame, by_mix, by_pins, at_rest},
    {"press Tab", &Scene::press_tab, at_rest, at_rest, at_rest, at_rest, by_edit},
};

const char* name_of(Kind kind) {
  const char* names[] = {"edited", "frame", "mix", "pins", "rest"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace

TEST_CASE("each_transition_leads_to_one_source_of_the_pose_and_undo_leads_back") {
  for (int i = 0; i < 2 * static_cast<int>(std::size(transitions)); ++i)
    for (const Kind before : {by_edit, by_frame, by_mix, by_pins, at_rest}) {
      const Transition& transition = transitions[i / 2];
      const bool keyed_weight = i % 2 == 1;
      CAPTURE(std::string(transition.name));
      CAPTURE(std::string(name_of(before)));
      CAPTURE(keyed_weight);
      Scene scene(before, keyed_weight);
      const auto positions = scene.w.document.pose().positions;
      (scene.*transition.act)();
      CHECK(std::string(name_of(scene.source())) == name_of(transition.after(before)));
      if (!transition.undoable) continue;
      scene.take_back();
      CHECK(std::string(name_of(scene.source())) == name_of(before));
      CHECK(scene.w.document.pose().positions == positions);
    }
}

TEST_CASE("an_opened_session_between_keys_shows_the_weights_of_its_keys") {
  Scene scene(by_frame);
  scene.go_to(21);
  const std::vector<double> shown = shown_weights(scene.w);
  REQUIRE(shown[1] > 0.1);
  files::Opened opened;
  opened.session = session_of(scene.w);
  opened.document = scene.w.document.without_history();
  opened.document->changed_source() = {};  // as in a file
  apply_opened(scene.w, std::move(opened));
  follow_time(scene.w, 0);
  CHECK(shown_weights(scene.w) == shown);
  CHECK(scene.source() == by_frame);
}

TEST_CASE("of_several_equal_poses_only_the_first_has_the_weight_of_a_key") {
  Scene scene(by_frame);
  add_poses(scene.w.document, {scene.w.document.library().poses[1]});
  scene.go_to(31);
  CHECK(shown_weights(scene.w) == std::vector<double>{0, 1, 0});
}
