// Draws the panels without OpenGL, files and background work: a frame takes about a millisecond.
#pragma once

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/ball.h"
#include "support/user_input.h"
#include "ui/imgui_bridge.h"
#include "ui/panels.h"
#include "workspace/playing.h"
#include "workspace/pointer.h"

namespace viete::test {

/// The panels over a workspace. Wishes stay in Workspace::jobs, the model is never deformed.
class PanelDriver : public UserInput {
public:
  explicit PanelDriver(workspace::Workspace w = ball_workspace(2), glm::vec2 size = {1280, 800},
                       float scale = 1)
      : workspace_(std::move(w)), size_(size), scale_(scale) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = io.LogFilename = nullptr;
    io.ConfigInputTextCursorBlink = false;
    platform::InputQueue::configure();
    fonts_ = ui::add_fonts(scale, true);
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);  // builds the fonts
    ui::apply_style(true);
    document().put_deformer({});
    for (const char* title : {"Transform", "Select", "Display", "Analysis"})
      workspace_.preferences.layout.sections[title] = true;
    frame(3);
  }
  ~PanelDriver() override { ImGui::DestroyContext(); }

  workspace::Workspace& workspace() final { return workspace_; }
  const ui::Recorder& recorder() final { return recorder_; }
  platform::InputQueue& input() final { return input_; }
  void frame(int count = 1) final {
    for (int i = 0; i < count; ++i) draw();
  }

  /// Returns the written texts in drawing order, separated by spaces. Texts outside of the window are
  /// missing.
  std::string text() const;
  bool says(const std::string& words) const { return text().find(words) != std::string::npos; }

private:
  void draw() {
    place_viewport();
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {size_.x, size_.y};
    io.DisplayFramebufferScale = {scale_, scale_};
    io.DeltaTime = 1.0f / 60;
    input_.feed_frame();
    ImGui::NewFrame();
    ui::handle_input(workspace_, pointer_);
    workspace_.view.camera.animate(io.DeltaTime);
    place_viewport();
    workspace::follow_time(workspace_, io.DeltaTime);
    recorder_.begin_frame();
    ui::draw_panels(
        {workspace_, fonts_, ui::palette(workspace_.view.options.dark), &recorder_, field_colors_});
    ImGui::Render();
  }
  void place_viewport() {
    auto& view = workspace_.view;
    view.camera.viewport =
        workspace::viewport_of(view.split,
                               workspace::view_between(workspace_.preferences.layout, size_,
                                                       view.options.panels, workspace_.panels.notice_height),
                               view.split.active);
  }

  workspace::Workspace workspace_;
  workspace::Pointer pointer_;
  platform::InputQueue input_{ui::imgui_key};
  ui::Recorder recorder_;
  ui::Fonts fonts_;
  ui::FieldColors field_colors_{std::vector<ImU32>(33), std::vector<ImU32>(33)};
  glm::vec2 size_;
  float scale_;
};

inline const ImVector<ImFontGlyph>& drawn_glyphs() {
  ImFont& font = *ImGui::GetIO().FontDefault;
#if IMGUI_VERSION_NUM >= 19200
  return font.GetFontBaked(font.LegacySize)->Glyphs;
#else
  return font.Glyphs;
#endif
}

// The vertices of a character have its corners in the font's texture, which identify it.
inline std::string PanelDriver::text() const {
  std::string all;
  const auto& glyphs = drawn_glyphs();
  float pen = 0, line = 0;
  for (int list = 0; list < ImGui::GetDrawData()->CmdListsCount; ++list) {
    const auto& vertices = ImGui::GetDrawData()->CmdLists[list]->VtxBuffer;
    for (int i = 0; i + 3 < vertices.Size; ++i) {
      const ImDrawVert &low = vertices[i], &high = vertices[i + 2];
      const auto is_drawn = [&](const ImFontGlyph& g) {
        return g.U0 == low.uv.x && g.V0 == low.uv.y && g.U1 == high.uv.x && g.V1 == high.uv.y;
      };
      const auto glyph = std::find_if(glyphs.begin(), glyphs.end(), is_drawn);
      if (glyph == glyphs.end() || glyph->U0 == glyph->U1) continue;
      const float size = (high.pos.x - low.pos.x) / (glyph->X1 - glyph->X0);
      const float begin = low.pos.x - size * glyph->X0, top = low.pos.y - size * glyph->Y0;
      if (std::abs(begin - pen) > 0.5f || std::abs(top - line) > 0.5f) all += ' ';
      char utf8[5] = {};
      ImTextCharToUtf8(utf8, glyph->Codepoint);
      all += utf8;
      pen = begin + size * glyph->AdvanceX;
      line = top;
      i += 3;
    }
  }
  return all;
}

}  // namespace viete::test
