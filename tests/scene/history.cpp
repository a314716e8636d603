#include "scene/history.h"

#include <doctest/doctest.h>

using namespace viete::scene;

namespace {

Snapshot at(double x) {
  return {{{{x, 0, 0}}, {}}, {}, {}, nullptr, {}};
}
double x_of(const Snapshot& s) {
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

TEST_CASE("a_new_edit_ends_redo") {
  History h;
  h.record("one", at(0));
  h.undo(at(1));
  h.record("other", at(0));
  CHECK_FALSE(h.can_redo());
}
