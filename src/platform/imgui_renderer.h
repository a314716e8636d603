// Draws the panels of Dear ImGui with OpenGL 3.3. The renderer of ImGui itself does not work with OSMesa.
#pragma once

#include <imgui.h>

#include <vector>

#include "render/gl.h"

namespace viete::platform {

/// Uses the ImGui context that was current at construction. Works with ImGui 1.86 to 1.92. Add fonts before
/// upload_fonts(). The texture id in a draw command is a GL texture name: (ImTextureID)(intptr_t)name.
class ImGuiRenderer {
public:
  explicit ImGuiRenderer(const render::Gl& gl);

  /// Builds and uploads the font atlas. Call this again after a change of the fonts.
  void upload_fonts();
  /// Draws into the bound framebuffer, whose size must be DisplaySize * FramebufferScale. `data` is the
  /// result of ImGui::GetDrawData() after ImGui::Render(). Turns blending and scissor off at the end.
  void draw(const ImDrawData& data);
  /// True if the last draw() had equal data, so that another draw() would give the same picture.
  bool has_drawn(const ImDrawData& data) const;

private:
  struct Drawn {
    ImVector<ImDrawVert> vertices;
    ImVector<ImDrawIdx> indices;
    ImVector<ImDrawCmd> commands;
  };
  void remember(const ImDrawData& data);
  void upload(const ImDrawList& list);
  void draw_list(const ImDrawList& list, const ImDrawData& data);

  const render::Gl& gl_;
  render::Program program_;
  render::VertexArray vertex_array_;
  render::Buffer vertices_, indices_;
  render::Texture font_;
  std::vector<Drawn> drawn_;
  ImVec2 size_{0, 0}, scale_{0, 0};  // DisplaySize and FramebufferScale of the last draw()
};

}  // namespace viete::platform
