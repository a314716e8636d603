#include "scene/document/history.h"

#include <doctest/doctest.h>

using namespace viete::scene;

namespace {

DocumentState at(double x) {
  DocumentState state;
  state.pose.positions = {{x, 0, 0}};
  return state;
}
double x_of(const DocumentState& s) {
  return s.pose.positions[0][0];
}

}  // namespace

TEST_CASE("undo_and_redo_walk_the_same_path") {
  History h;
  CHECK_FALSE(h.can_undo());
  h.record("one", at(0));
  h.record("two", at(1));
  CHECK(h.undo_label() == "two");
  CHECK(x_of(h.undo(at(2))) == 1);
  CHECK(x_of(h.undo(at(1))) == 0);
  CHECK_FALSE(h.can_undo());
  CHECK(x_of(h.redo(at(0))) == 1);
  CHECK(x_of(h.redo(at(1))) == 2);
  CHECK_FALSE(h.can_redo());
}

TEST_CASE("all_edits_are_listed_by_their_labels_and_taking_back_moves_among_them") {
  History h;
  for (int i = 0; i < 4; ++i) h.record("edit " + std::to_string(i), at(i));
  const std::vector<std::string> all = {"edit 0", "edit 1", "edit 2", "edit 3"};
  CHECK(h.labels() == all);
  CHECK(h.position() == 4);
  h.undo(at(4));
  h.undo(at(3));
  CHECK(h.labels() == all);
  CHECK(h.position() == 2);
  CHECK(h.redo_label() == "edit 2");
}

TEST_CASE("a_new_edit_ends_redo") {
  History h;
  h.record("one", at(0));
  h.undo(at(1));
  h.record("other", at(0));
  CHECK_FALSE(h.can_redo());
}

TEST_CASE("an_edit_that_is_called_off_leaves_what_could_be_repeated") {
  History h;
  h.record("one", at(0));
  h.undo(at(1));
  const unsigned long before = h.recorded();
  h.record("slide", at(0));
  CHECK(h.recorded() == before + 1);
  CHECK_FALSE(h.can_redo());
  CHECK(x_of(h.drop_last()) == 0);
  CHECK(h.recorded() == before);
  CHECK_FALSE(h.can_undo());
  CHECK(x_of(h.redo(at(0))) == 1);
}

TEST_CASE("no_number_of_clicks_takes_an_edit_out_of_reach") {
  History h;
  const auto mask =
      std::make_shared<const std::vector<float>>(5u << 20, 1.0f);  // so large that few states fit
  const auto state = [&](double x) {
    DocumentState s = at(x);
    s.mask = mask;
    return s;
  };
  h.record("one", state(0));
  h.record("two", state(1));
  for (int i = 0; i < 100; ++i) h.record_selection(state(2));
  int steps = 0;
  DocumentState now = state(2);
  while (h.can_undo() && h.undo_label() == "select") now = h.undo(now), ++steps;
  CHECK(steps < 20);
  REQUIRE(h.undo_label() == "two");
  now = h.undo(now);
  CHECK(x_of(now) == 1);
  REQUIRE(h.undo_label() == "one");
  now = h.undo(now);
  CHECK(x_of(now) == 0);
  while (h.can_redo()) now = h.redo(now);
  CHECK(x_of(now) == 2);
}
