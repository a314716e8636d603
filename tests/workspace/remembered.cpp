#include "workspace/preferences.h"

#include "base/error.h"
#include "support/folder.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;

TEST_CASE("a_recent_file_stands_once_at_the_front_and_twelve_are_kept") {
  Preferences preferences;
  for (int i = 0; i < 20; ++i) preferences.add({"/m" + std::to_string(i) + ".obj", {}});
  CHECK(preferences.recent.size() == 12);
  CHECK(preferences.recent.front().file == "/m19.obj");
  preferences.add({"/m15.obj", {}});
  CHECK(preferences.recent.size() == 12);
  CHECK(preferences.recent.front().file == "/m15.obj");
  CHECK(preferences.recent[1].file == "/m19.obj");
}

TEST_CASE("preferences_are_restored") {
  const test::TemporaryFolder folder;
  Preferences preferences;
  CHECK(read_preferences(folder / "r.json") == preferences);
  preferences.add({"/a.ply", "/c.obj"});
  preferences.add({"/b.viete", {}});
  preferences.add({"/caf\xe9/a.ply", "/caf\xe9/c.obj"});
  preferences.folder =
      "/some\xff"
      "where";
  preferences.hints = preferences.ask_keys = preferences.dark = false;
  preferences.coarse_motion = true;
  preferences.window = glm::ivec2(1000, 700);
  preferences.layout.width = {300, 400};
  preferences.layout.folded = {true, false};
  preferences.layout.last = Column::tools;
  preferences.layout.timeline = true;
  preferences.layout.sections = {{"Analysis", true}, {"Model", false}};
  preferences.keymap.set_preset(KeyPreset::maya);
  preferences.keymap.change("save_session", *shortcut_of("Ctrl+J"));
  write_preferences(folder / "r.json", preferences);
  CHECK(read_preferences(folder / "r.json") == preferences);
  preferences.window = glm::ivec2(1, 700);  // an invalid size
  write_preferences(folder / "r.json", preferences);
  CHECK_FALSE(read_preferences(folder / "r.json").window);
}

TEST_CASE("a_damaged_file_is_an_error_and_is_replaced_by_the_next_write") {
  const test::TemporaryFolder folder;
  for (const char* damaged :
       {R"({"recent": [3]})", R"({"window": [1, -5]})", R"({"layout": {"last": "x"}})"}) {
    test::put_file(folder / "r.json", damaged);
    CHECK_THROWS_AS(read_preferences(folder / "r.json"), base::Error);
  }
  Preferences preferences;
  preferences.add({"/a.ply", {}});
  write_preferences(folder / "r.json", preferences);
  CHECK(read_preferences(folder / "r.json") == preferences);
}

TEST_CASE("both_columns_are_shown_where_the_view_keeps_its_least_width") {
  const PanelLayout layout;
  const auto wide = shown_columns(layout, 1280);
  CHECK(wide.tools == 320);
  CHECK(wide.methods == 320);
  const auto tight = shown_columns(layout, PanelLayout::least_view + 2 * PanelLayout::least_width);
  CHECK(tight.tools == PanelLayout::least_width);
  CHECK(tight.methods == PanelLayout::least_width);
}

TEST_CASE("a_narrow_window_shows_the_column_unfolded_last") {
  PanelLayout layout;
  CHECK(shown_columns(layout, 800).methods == 320);
  CHECK(shown_columns(layout, 800).tools == 0);
  toggle_column(layout, Column::tools, 800);
  CHECK(shown_columns(layout, 800).methods == 0);
  CHECK(shown_columns(layout, 800).tools == 320);
  CHECK(shown_columns(layout, 1280).methods == 320);
  toggle_column(layout, Column::tools, 800);
  CHECK(shown_columns(layout, 800).methods == 320);
}

TEST_CASE("a_folded_column_leaves_its_place_to_the_view") {
  PanelLayout layout;
  toggle_column(layout, Column::tools, 1280);
  const Viewport v = view_between(layout, {1280, 800}, true);
  CHECK(v.origin.x == 0);
  CHECK(v.size.x == 960);
  CHECK(view_between(layout, {1280, 800}, false).size == glm::vec2(1280, 800));
}

TEST_CASE("a_row_of_notices_takes_its_height_from_columns_and_view") {
  for (const bool panels : {true, false}) {
    const Viewport without = view_between({}, {1280, 800}, panels),
                   with = view_between({}, {1280, 800}, panels, 40);
    CHECK(with.origin == without.origin + glm::vec2(0, 40));
    CHECK(with.size == without.size - glm::vec2(0, 40));
    CHECK(column_height(with) == column_height(without) - 40);
  }
}

TEST_CASE("a_width_stays_within_its_limits_and_leaves_room_for_the_view") {
  PanelLayout layout;
  set_width(layout, Column::methods, 10, 1280);
  CHECK(layout.width[1] == PanelLayout::least_width);
  set_width(layout, Column::methods, 5000, 1280);
  CHECK(layout.width[1] == PanelLayout::largest_width);
  set_width(layout, Column::tools, 5000, 1280);
  CHECK(view_between(layout, {1280, 800}, true).size.x >= PanelLayout::least_view);
}
