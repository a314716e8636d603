// The program when idle and under heavy input.
#include <cctype>

#include "program/driver.h"

using namespace viete;
using test::Driver;

TEST_CASE("the_viewer_rests_with_a_cage_without_one_and_with_nothing_open") {
  for (const int open : {0, 1, 2}) {
    Driver d;
    if (open == 1) REQUIRE(d.open({test::dragon}));
    if (open == 2) REQUIRE(d.open({test::dragon, test::dragon_cage}));
    d.settle();
    d.frame(5);
    CHECK_MESSAGE(!d.viewer().wants_frame(), open);
  }
}

TEST_CASE("typed_text_arrives_in_one_frame_in_order_however_long") {
  Driver d;
  d.frame(3);
  d.press_key(scene::key('O'), true);
  d.frame(2);
  REQUIRE(d.workspace().browser.open);
  d.click("file_path");
  d.press_key('A', true);
  const std::string text = "/home/somebody/Models of Dragons/dragoon-AA_99.obj";
  auto& input = d.viewer().input();
  const auto put = [&](const std::string& letters) {
    for (const char c : letters) {
      const bool capital = std::isupper(static_cast<unsigned char>(c));
      const int code = std::toupper(static_cast<unsigned char>(c));
      if (capital) input.push(platform::InputEvent::key(Driver::left_shift, true));
      input.push(platform::InputEvent::key(code, true));
      input.push(platform::InputEvent::typed(std::string(1, c)));
      input.push(platform::InputEvent::key(code, false));
      if (capital) input.push(platform::InputEvent::key(Driver::left_shift, false));
    }
  };
  put(text);
  d.frame();
  CHECK(input.empty());
  CHECK(d.workspace().browser.path == text);
  // Events before a text edit apply before it, those after it apply after it.
  for (int i = 0; i < 3; ++i) {
    input.push(platform::InputEvent::key(259, true));
    input.push(platform::InputEvent::key(259, false));
  }
  put("ply");
  d.frame(8);
  CHECK(input.empty());
  CHECK(d.workspace().browser.path == text.substr(0, text.size() - 3) + "ply");
}

TEST_CASE("a_press_and_the_movement_after_it_are_not_mixed_up") {
  Driver d;
  d.open_dragon();
  const auto v = d.free_vertex();
  const glm::vec2 from = glm::round(d.vertex(v)), to = from + glm::vec2(50, 20), offset = d.vertex(v) - from;
  d.move(from);
  auto& input = d.viewer().input();
  input.push(platform::InputEvent::button(0, true));  // all between two frames
  input.push(platform::InputEvent::move(from + glm::vec2(20, 10)));
  input.push(platform::InputEvent::move(to));
  input.push(platform::InputEvent::button(0, false));
  d.frame(6);
  CHECK(glm::distance(d.vertex(v), to + offset) < 0.05f);
}

TEST_CASE("keys_of_one_frame_keep_their_modifiers_and_their_order") {
  Driver d;
  d.settle();
  const int g = 'G', x = 'X', t = 'T';
  auto& input = d.viewer().input();
  const auto view = d.workspace().view;
  d.key(Driver::left_shift, true);
  for (const auto& [code, down] : {std::pair{t, true}, {Driver::left_shift, false}, {t, false}}) {
    input.push(platform::InputEvent::key(
        code, down));  // Shift is released before the key: still Shift+T, which is no shortcut
  }
  d.frame(4);
  CHECK(d.workspace().view == view);
  for (const int code : {g, x}) {
    input.push(platform::InputEvent::key(code, true));
  }
  for (const int code : {g, x}) {
    input.push(platform::InputEvent::key(code, false));
  }
  d.frame(4);
  CHECK(d.workspace().view.grid != view.grid);
  CHECK(d.workspace().view.axes != view.axes);
  CHECK(input.empty());
}
