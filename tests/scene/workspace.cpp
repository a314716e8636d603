#include "scene/workspace/workspace.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "scene/document/edit.h"
#include "scene/files/session_parts.h"
#include "scene/posed_cube.h"

using namespace viete;
using namespace viete::scene;

TEST_CASE("what_a_held_slider_has_done_is_called_off_to_the_last_bit") {
  Workspace w;
  w.document = test::cube_document();
  set_radius(w.document, 0.3);
  set_radius(w.document, 0.5123456789);
  undo(w.document);
  REQUIRE(w.document.history.can_redo());
  const deform::Scheme scheme = w.document.scheme;
  const std::string label = w.document.history.undo_label();
  take_hold(w);
  for (const double radius : {0.4, 0.2}) set_radius(w.document, radius);
  w.handling.soft.radius = 0.7;
  w.brush.radius = 99;
  w.making.wish.triangles = 444;
  w.remembered.layout.width[1] = 400;
  call_off_hold(w);
  CHECK(w.document.scheme == scheme);
  CHECK(w.document.history.undo_label() == label);
  CHECK(w.document.history.can_redo());
  const Workspace fresh;
  CHECK(w.handling == fresh.handling);
  CHECK(w.brush.radius == fresh.brush.radius);
  CHECK(w.making.wish.triangles == fresh.making.wish.triangles);
  CHECK(w.remembered.layout == fresh.remembered.layout);
}

TEST_CASE("steps_that_go_on_an_older_edit_are_called_off_without_it") {
  Workspace w;
  w.document = test::cube_document();
  set_radius(w.document, 0.3);
  take_hold(w);
  set_radius(w.document, 0.4);  // still the same entry
  call_off_hold(w);
  CHECK(w.document.scheme.weighting.radius == 0.3);
  CHECK(w.document.history.can_undo());
  undo(w.document);
  CHECK_FALSE(w.document.history.can_undo());
}

TEST_CASE("nothing_of_another_document_is_called_off") {
  Workspace w;
  w.document = test::cube_document();
  take_hold(w);
  ++w.opened;
  w.brush.radius = 99;
  call_off_hold(w);
  CHECK(w.brush.radius == 99);
}

TEST_CASE("whether_sliders_move_only_what_is_selected_is_kept_and_off_where_nothing_is_said") {
  Handling handling;
  CHECK_FALSE(handling.mix_selected);
  std::vector<std::string> warnings;
  for (const bool on : {true, false}) {
    handling.mix_selected = on;
    const nlohmann::json json = handling_json(handling);
    CHECK(handling_of(JsonReader(json, "a.viete"), warnings) == handling);
  }
  CHECK(warnings.empty());
}

TEST_CASE("the_time_left_is_right_soon_after_the_speed_has_changed") {
  struct Phase {
    double until, rate;
  };
  const std::vector<std::vector<Phase>> works = {{{1, 0.05}, {6, 0.95 / 5}},  // slow, then fast
                                                 {{1, 0.6}, {9, 0.05}},       // fast, then slow
                                                 {{10, 0.1}}};                // even
  for (const auto& work : works) {
    TimeLeft left;
    double began = 0, done = 0;
    for (const auto& [until, rate] : work) {
      for (double seconds = began; seconds < until; seconds += 0.016) {
        const auto known = left.of({true, "binding", done + rate * (seconds - began), seconds, seconds});
        const double truth = work.back().until - seconds;
        if (until < work.back().until || seconds < 2 * began || seconds < 1) continue;
        REQUIRE(known);
        CHECK(*known / truth == doctest::Approx(1).epsilon(0.15));
      }
      done += rate * (until - began);
      began = until;
    }
  }
  TimeLeft left;
  CHECK_FALSE(left.of({true, "reading", 0.5, 0.1, 0.1}));
  CHECK(left.of({true, "reading", 0.5, 4, 4}));
  CHECK_FALSE(left.of({true, "binding", 0.01, 0.6, 5}));
}
