#include "platform/imgui_renderer.h"

#include "support/stage.h"

using namespace viete;

namespace {

/// A renderer with its own ImGui context. The panels cover the whole stage.
struct Panels {
  explicit Panels(float framebuffer_scale = 1) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = ImVec2(static_cast<float>(stage.view.size.x) / framebuffer_scale,
                            static_cast<float>(stage.view.size.y) / framebuffer_scale);
    io.DisplayFramebufferScale = ImVec2(framebuffer_scale, framebuffer_scale);
    io.DeltaTime = 1.0F / 60;
    renderer.upload_fonts();
  }

  template <class Build>
  render::Image picture(Build build) {
    ImGui::NewFrame();
    build(*ImGui::GetForegroundDrawList());
    ImGui::Render();
    return stage.picture([&] { renderer.draw(*ImGui::GetDrawData()); });
  }

  test::Stage stage;
  struct Context {
    Context() { ImGui::CreateContext(); }
    ~Context() { ImGui::DestroyContext(); }
  } context;
  platform::ImGuiRenderer renderer{stage.gl};
};

constexpr ImU32 orange = IM_COL32(255, 128, 0, 255);

std::size_t count(const render::Image& image, const render::Rgba8& color) {
  std::size_t found = 0;
  for (int i = 0; i < image.width * image.height; ++i)
    found += image.pixel(i % image.width, i / image.width) == color ? 1 : 0;
  return found;
}

}  // namespace

TEST_CASE("rectangle_is_drawn_where_asked_and_clipped") {
  Panels panels;
  const render::Image image = panels.picture([](ImDrawList& list) {
    for (int i = 0; i < 20000; ++i)  // more than 65536 vertices
      list.AddRectFilled(ImVec2(0, 0), ImVec2(1, 1), IM_COL32_WHITE);
    list.AddRectFilled(ImVec2(20, 30), ImVec2(60, 50), orange);
    list.PushClipRect(ImVec2(100, 40), ImVec2(110, 60));
    list.AddRectFilled(ImVec2(80, 0), ImVec2(320, 200), orange);
    list.PopClipRect();
    list.PushClipRect(ImVec2(500, 500), ImVec2(600, 600));  // outside
    list.AddRectFilled(ImVec2(0, 0), ImVec2(1000, 1000), orange);
    list.PopClipRect();
    list.PushClipRect(ImVec2(-500, -500), ImVec2(5000, 5000));
    list.AddRectFilled(ImVec2(-50, -50), ImVec2(10, 10), orange);
    list.PopClipRect();
  });
  CHECK(count(image, {255, 128, 0, 255}) == 40 * 20 + 10 * 20 + 100);
  for (const glm::ivec2 inside : {glm::ivec2(20, 30), {59, 49}, {100, 40}, {109, 59}, {9, 9}})
    CHECK(image.pixel(inside.x, inside.y)[0] == 255);
  for (const glm::ivec2 outside : {glm::ivec2(19, 30), {20, 50}, {99, 40}, {110, 59}})
    CHECK(image.pixel(outside.x, outside.y)[0] == 0);
}

TEST_CASE("framebuffer_scale_doubles_everything") {
  Panels panels(2);
  const render::Image image = panels.picture([](ImDrawList& list) {
    list.PushClipRect(ImVec2(20, 30), ImVec2(40, 50));
    list.AddRectFilled(ImVec2(20, 30), ImVec2(60, 40), orange);
    list.PopClipRect();
  });
  CHECK(count(image, {255, 128, 0, 255}) == 40 * 20);
  CHECK(image.pixel(40, 60)[0] == 255);
}

TEST_CASE("translucent_colours_and_text_are_blended") {
  Panels panels;
  const render::Image image = panels.picture([](ImDrawList& list) {
    list.AddRectFilled(ImVec2(0, 0), ImVec2(50, 50), IM_COL32(255, 255, 255, 255));
    list.AddRectFilled(ImVec2(0, 0), ImVec2(50, 50), IM_COL32(0, 0, 0, 128));
    list.AddText(ImVec2(100, 100), IM_COL32_WHITE, "HHHH");
  });
  CHECK(image.pixel(10, 10)[0] == doctest::Approx(127).epsilon(0.02));
  CHECK(test::count_not_black(image) > 2500 + 40);
  CHECK(test::count_not_black(image) < 2500 + 400);
}

TEST_CASE("custom_texture_is_shown_as_an_image") {
  Panels panels;
  const render::Gl& gl = panels.stage.gl;
  const render::Texture texture(gl);
  const std::uint8_t green[4] = {0, 200, 0, 255};
  gl.BindTexture(GL_TEXTURE_2D, texture.id());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, green);
  const render::Image image = panels.picture([&](ImDrawList& list) {
    list.AddImage((ImTextureID)(std::intptr_t)texture.id(), ImVec2(10, 10), ImVec2(20, 20));
    list.AddRectFilled(ImVec2(40, 10), ImVec2(50, 20), orange);
  });
  CHECK(count(image, {0, 200, 0, 255}) == 100);
  CHECK(count(image, {255, 128, 0, 255}) == 100);
}

TEST_CASE("has_drawn_recognises_only_equal_data") {
  Panels panels;
  const auto draw = [&](float x, ImU32 color) {
    panels.picture([&](ImDrawList& list) { list.AddRectFilled(ImVec2(x, 30), ImVec2(60, 50), color); });
    return panels.renderer.has_drawn(*ImGui::GetDrawData());
  };
  const auto would_be_the_same = [&](float x, ImU32 color) {
    ImGui::NewFrame();
    ImGui::GetForegroundDrawList()->AddRectFilled(ImVec2(x, 30), ImVec2(60, 50), color);
    ImGui::Render();
    return panels.renderer.has_drawn(*ImGui::GetDrawData());
  };
  CHECK(draw(20, orange));
  CHECK(would_be_the_same(20, orange));
  CHECK_FALSE(would_be_the_same(21, orange));
  CHECK_FALSE(would_be_the_same(20, orange - 1));
  ImGui::GetIO().DisplaySize.x -= 1;
  CHECK_FALSE(would_be_the_same(20, orange));
  ImGui::GetIO().DisplaySize.x += 1;
  panels.renderer.upload_fonts();
  CHECK_FALSE(would_be_the_same(20, orange));
}
