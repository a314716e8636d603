#include "workspace/time_view.h"

#include "document/time_edit.h"
#include "support/commands.h"
#include "support/cube.h"
#include "support/edits.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;

namespace {

Workspace keyed_workspace(std::initializer_list<int> frames) {
  Workspace w = test::cube_workspace();
  for (const int frame : frames) set_key(w.document, frame);
  return w;
}

void drag(Workspace& w, std::initializer_list<double> frames) {
  for (const double frame : frames) drag_time(w, frame);
  release_time(w);
}

}  // namespace

TEST_CASE("the_fitted_window_contains_the_playback_range_and_all_keys") {
  Workspace w = keyed_workspace({-20, 5});
  const FrameWindow seen = fitting(w.document.timeline());
  CHECK(seen.first < -20);
  CHECK(seen.last > w.document.timeline().last);
  CHECK(seen.frame_at(seen.share_of(7)) == doctest::Approx(7));
}

TEST_CASE("zooming_leaves_the_frame_under_the_pointer_and_ends_somewhere") {
  FrameWindow seen{0, 100};
  const FrameWindow nearer = zoomed(seen, 0.25, 0.5);
  CHECK(nearer.length() == doctest::Approx(50));
  CHECK(nearer.frame_at(0.25) == doctest::Approx(25));
  for (int i = 0; i < 200; ++i) seen = zoomed(seen, 0.9, 0.5);
  CHECK(seen.length() == doctest::Approx(FrameWindow::least_length));
  for (int i = 0; i < 200; ++i) seen = zoomed(seen, 0.1, 3);
  CHECK(std::isfinite(seen.first));
  CHECK(seen.length() <= 2.0 * Timeline::largest_frame + 1);
}

TEST_CASE("lines_of_the_ruler_are_1_2_or_5_times_a_power_of_ten_apart") {
  CHECK(ruler_step({0, 10}, 20) == 1);
  CHECK(ruler_step({0, 20}, 10) == 2);
  CHECK(ruler_step({0, 30}, 10) == 5);
  CHECK(ruler_step({0, 60}, 10) == 10);
  CHECK(ruler_step({0, 150}, 10) == 20);
  CHECK(ruler_step({0, 2e6}, 10) == 200'000);
  CHECK(ruler_step({0, 10}, 0) == 10);
}

TEST_CASE("a_press_selects_a_key_shift_adds_one_and_elsewhere_clears") {
  Workspace w = keyed_workspace({1, 10, 20});
  press_keys(w, 10, 10, false);
  release_time(w);
  CHECK(w.view.time.selected == KeyPlaces{10});
  press_keys(w, 20, 20, true);
  CHECK(w.view.time.selected == KeyPlaces{10, 20});
  press_keys(w, 10, 10, true);
  CHECK(w.view.time.selected == KeyPlaces{20});
  press_keys(w, 15, {}, false);
  drag(w, {5, 4, 0});
  CHECK(w.view.time.selected == KeyPlaces{1, 10});
  press_keys(w, 15, {}, true);
  drag(w, {25});
  CHECK(w.view.time.selected == KeyPlaces{1, 10, 20});
  press_keys(w, 15, {}, false);
  release_time(w);
  CHECK(w.view.time.selected.empty());
}

TEST_CASE("selected_keys_are_dragged_together_and_each_drag_is_one_edit") {
  Workspace w = keyed_workspace({1, 10, 20});
  set_camera_key(w.document, 10, w.view.camera.pose());
  const Timeline before = w.document.timeline();
  const std::size_t edits = test::edit_count(w.document.history());
  w.view.time.selected = {10, 20};
  press_keys(w, 20, 20, false);
  drag(w, {22, 29, 25.2});
  CHECK(key_frames(w.document.timeline()) == std::vector{1, 15, 25});
  CHECK(w.document.timeline().cameras.front().frame == 15);
  CHECK(w.view.time.selected == KeyPlaces{15, 25});
  CHECK(test::edit_count(w.document.history()) == edits + 1);
  press_keys(w, 15, 15, false);
  drag(w, {15.2});  // a click without a drag is not an edit
  CHECK(test::edit_count(w.document.history()) == edits + 1);
  w.view.time.selected = {15, 25};
  press_keys(w, 15, 15, false);
  drag(w, {1e9});
  CHECK(w.view.time.selected == KeyPlaces{Timeline::largest_frame - 10, Timeline::largest_frame});
  CHECK(test::edit_count(w.document.history()) == edits + 2);
  undo(w.document);
  undo(w.document);
  CHECK(w.document.timeline() == before);
}

TEST_CASE("a_drag_over_other_keys_and_back_takes_none_away") {
  Workspace w = keyed_workspace({1, 10, 20});
  press_keys(w, 10, 10, false);
  drag_time(w, 20);
  CHECK(key_frames(w.document.timeline()) == std::vector{1, 20});
  drag_time(w, 12);
  CHECK(key_frames(w.document.timeline()) == std::vector{1, 12, 20});
  cancel_time(w);
  CHECK(key_frames(w.document.timeline()) == std::vector{1, 10, 20});
  CHECK(w.view.time.selected == KeyPlaces{10});
}

TEST_CASE("the_ruler_goes_to_whole_frames") {
  Workspace w = keyed_workspace({1, 10});
  press_ruler(w, 4.4);
  CHECK(w.document.frame() == 4);
  drag(w, {7.6});
  CHECK(w.document.frame() == 8);
}

TEST_CASE("panning_moves_what_is_seen_and_escape_takes_it_back") {
  Workspace w = keyed_workspace({1});
  w.view.time.seen = {0, 100};
  press_pan(w, 50);
  drag_time(w, 40);
  CHECK(w.view.time.seen == FrameWindow{10, 110});
  cancel_time(w);
  CHECK(w.view.time.seen == FrameWindow{0, 100});
}

TEST_CASE("easing_is_of_the_selected_keys_or_of_the_one_before_the_frame") {
  Workspace w = keyed_workspace({1, 10, 20});
  w.document.put_frame(12);
  CHECK(eased_keys(w) == KeyPlaces{10});
  w.view.time.selected = {1, 10, 20};  // no key follows the key at 20
  CHECK(eased_keys(w) == KeyPlaces{1, 10});
  w.view.time.selected = {20};
  CHECK(eased_keys(w) == KeyPlaces{10});
  w.document.put_frame(0);
  CHECK(eased_keys(w).empty());
}

TEST_CASE("other_edits_are_disabled_while_keys_are_dragged") {
  Workspace w = keyed_workspace({1, 10});
  press_keys(w, 10, 10, false);
  drag_time(w, 12);
  CHECK_FALSE(test::run_command(w, "undo"));
  CHECK_FALSE(test::run_command(w, "set_key"));
  release_time(w);
  CHECK(test::run_command(w, "undo"));
  CHECK(key_frames(w.document.timeline()) == std::vector{1, 10});
  w.view.time.selected = {1};
  CHECK_FALSE(test::run_command(w, "delete_keys"));
  w.view.time.hovered = true;
  CHECK(test::run_command(w, "delete_keys"));
  CHECK(key_frames(w.document.timeline()) == std::vector{10});
}
