#include "platform/input_queue.h"

#include <doctest/doctest.h>
#include <imgui.h>

using viete::platform::InputEvent;
using viete::platform::InputQueue;

namespace {

constexpr int key_a = 'A', key_shift = 340;

int table(int code) {
#if IMGUI_VERSION_NUM < 18700
  return code;
#else
  return code == key_a ? ImGuiKey_A : 0;
#endif
}

// An ImGui context without content. Records the input after each frame.
struct Frames {
  InputQueue queue{table};

  Frames() {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {100, 100};
    io.DeltaTime = 1.0F / 60;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    InputQueue::configure();
  }
  ~Frames() { ImGui::DestroyContext(); }
  void frame() {
    queue.feed_frame();
    ImGui::NewFrame();
    ImGui::EndFrame();
  }
};

// Returns the characters that a focused text field gets in the next frame.
std::string typed_in_a_frame(Frames& f) {
  ImGuiIO& io = ImGui::GetIO();
  io.WantTextInput = true;
  f.queue.feed_frame();
  ImGui::NewFrame();
  std::string typed;
  for (const ImWchar c : io.InputQueueCharacters) typed += static_cast<char>(c);
  ImGui::EndFrame();
  return typed;
}

}  // namespace

TEST_CASE("a_click_between_two_frames_is_not_lost_and_movement_waits_for_its_frames") {
  Frames f;
  const ImGuiIO& io = ImGui::GetIO();
  for (int x = -30; x <= 20; ++x) f.queue.push(InputEvent::move({static_cast<float>(x), 30}));
  f.queue.push(InputEvent::button(0, true));
  f.queue.push(InputEvent::button(0, false));
  f.queue.push(InputEvent::move({60, 30}));
  f.frame();
  CHECK(io.MouseDown[0]);
  CHECK(io.MousePos.x == 20);
  f.frame();
  CHECK_FALSE(io.MouseDown[0]);
  CHECK(io.MousePos.x == 20);
  f.frame();
  CHECK(io.MousePos.x == 60);
  CHECK(f.queue.empty());
}

TEST_CASE("a_modifier_is_held_when_its_key_goes_down") {
  Frames f;
  f.queue.push(InputEvent::key(key_shift, true));
  f.queue.push(InputEvent::key(key_a, true));
  f.queue.push(InputEvent::key(key_shift, false));
  f.frame();
  CHECK(ImGui::GetIO().KeyShift);
  f.frame();
  CHECK_FALSE(ImGui::GetIO().KeyShift);
}

TEST_CASE("text_field_takes_text_at_once_and_text_after_a_key_later") {
  Frames f;
  const auto press = [&](int code, const char* text) {
    f.queue.push(InputEvent::key(code, true));
    if (*text) f.queue.push(InputEvent::typed(text));
    f.queue.push(InputEvent::key(code, false));
  };
  for (int i = 0; i < 60; ++i) press(key_a, "a");
  CHECK(typed_in_a_frame(f) == std::string(60, 'a'));
  CHECK(f.queue.empty());
  constexpr int backspace = 259;
  press(key_a, "b");
  press(backspace, "");
  press(key_a, "c");
  CHECK(typed_in_a_frame(f) == "b");
  CHECK_FALSE(f.queue.empty());
  std::string rest;
  for (int i = 0; i < 4; ++i) rest += typed_in_a_frame(f);
  CHECK(rest == "c");
  CHECK(f.queue.empty());
}

TEST_CASE("text_field_gets_ctrl_keys_and_key_releases") {
  Frames f;
  f.queue.push(InputEvent::key(key_a, true));
  f.frame();
  CHECK(ImGui::IsKeyDown(static_cast<ImGuiKey>(table(key_a))));
  f.queue.push(InputEvent::key(key_a, false));
  typed_in_a_frame(f);
  CHECK_FALSE(ImGui::IsKeyDown(static_cast<ImGuiKey>(table(key_a))));
  f.queue.push(InputEvent::key(341, true));
  f.queue.push(InputEvent::key(key_a, true));
  typed_in_a_frame(f);
  CHECK(ImGui::GetIO().KeyCtrl);
  CHECK(ImGui::IsKeyDown(static_cast<ImGuiKey>(table(key_a))));
}
