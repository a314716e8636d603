#include "platform/imgui_renderer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace viete::platform {

namespace {

const void* buffer_offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

/// A clip rectangle inside the framebuffer, in device pixels. The origin is at the bottom left.
struct Scissor {
  int x, y, width, height;
};

Scissor scissor(const ImDrawCmd& command, const ImDrawData& data) {
  const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
  const float full_width = data.DisplaySize.x * scale.x, full_height = data.DisplaySize.y * scale.y;
  const float left = std::max(0.0F, (command.ClipRect.x - origin.x) * scale.x);
  const float top = std::max(0.0F, (command.ClipRect.y - origin.y) * scale.y);
  const float right = std::min(full_width, (command.ClipRect.z - origin.x) * scale.x);
  const float bottom = std::min(full_height, (command.ClipRect.w - origin.y) * scale.y);
  return {static_cast<int>(left), static_cast<int>(full_height - bottom), static_cast<int>(right - left),
          static_cast<int>(bottom - top)};
}

// Compares bytes, also the unused bytes between members of T. ImGui sets these bytes to zero.
template <class T>
bool same(const ImVector<T>& a, const ImVector<T>& b) {
  return a.Size == b.Size &&
         (a.Size == 0 || std::memcmp(a.Data, b.Data, static_cast<std::size_t>(a.Size) * sizeof(T)) == 0);
}

bool same(const ImVec2& a, const ImVec2& b) {
  return a.x == b.x && a.y == b.y;
}

bool calls_back(const ImDrawList& list) {
  return std::any_of(list.CmdBuffer.begin(), list.CmdBuffer.end(),
                     [](const ImDrawCmd& c) { return c.UserCallback != nullptr; });
}

}  // namespace

ImGuiRenderer::ImGuiRenderer(const render::Gl& gl)
    : gl_(gl), program_(gl, "imgui"), vertex_array_(gl), vertices_(gl), indices_(gl), font_(gl) {
  ImGuiIO& io = ImGui::GetIO();
  io.BackendRendererName = "viete";
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
}

void ImGuiRenderer::upload_fonts() {
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
  render::set_texture(gl_, 0, font_, width, height, {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, pixels);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): ImTextureID is a pointer before ImGui 1.91.4, then an integer
  fonts.SetTexID((ImTextureID)(std::intptr_t)font_.id());
  drawn_.clear();
}

bool ImGuiRenderer::has_drawn(const ImDrawData& data) const {
  const auto count = static_cast<std::size_t>(data.CmdListsCount);
  if (count != drawn_.size() || !same(data.DisplaySize, size_) || !same(data.FramebufferScale, scale_))
    return false;
  for (std::size_t i = 0; i < count; ++i) {
    const ImDrawList& list = *data.CmdLists[static_cast<int>(i)];
    if (calls_back(list) || !same(list.CmdBuffer, drawn_[i].commands) ||
        !same(list.IdxBuffer, drawn_[i].indices) || !same(list.VtxBuffer, drawn_[i].vertices))
      return false;
  }
  return true;
}

void ImGuiRenderer::remember(const ImDrawData& data) {
  size_ = data.DisplaySize;
  scale_ = data.FramebufferScale;
  drawn_.resize(static_cast<std::size_t>(data.CmdListsCount));
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    const ImDrawList& list = *data.CmdLists[static_cast<int>(i)];
    drawn_[i] = {list.VtxBuffer, list.IdxBuffer, list.CmdBuffer};
  }
}

void ImGuiRenderer::draw(const ImDrawData& data) {
  remember(data);
  const float width = data.DisplaySize.x, height = data.DisplaySize.y;
  if (width <= 0 || height <= 0) return;  // the window is minimised
  gl_.Viewport(0, 0, static_cast<GLsizei>(width * data.FramebufferScale.x + 0.5F),
               static_cast<GLsizei>(height * data.FramebufferScale.y + 0.5F));
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.Enable(GL_BLEND);
  gl_.BlendEquation(GL_FUNC_ADD);
  gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_.Enable(GL_SCISSOR_TEST);

  program_.use();
  program_.set("image", 0);
  const glm::vec2 factor(2 / width, -2 / height);
  program_.set("placement",
               glm::vec4(-1 - data.DisplayPos.x * factor.x, 1 - data.DisplayPos.y * factor.y, factor));
  gl_.ActiveTexture(GL_TEXTURE0);
  for (int i = 0; i < data.CmdListsCount; ++i) draw_list(*data.CmdLists[i], data);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_BLEND);
  render::debug_check_gl(gl_, "panels");
}

void ImGuiRenderer::draw_list(const ImDrawList& list, const ImDrawData& data) {
  upload(list);
  for (const ImDrawCmd& command : list.CmdBuffer) {
    if (command.UserCallback != nullptr) {
      if (command.UserCallback != ImDrawCallback_ResetRenderState) command.UserCallback(&list, &command);
      continue;
    }
    const Scissor clip = scissor(command, data);
    if (clip.width <= 0 || clip.height <= 0) continue;
    gl_.Scissor(clip.x, clip.y, clip.width, clip.height);
    gl_.BindTexture(GL_TEXTURE_2D, static_cast<GLuint>((std::intptr_t)command.GetTexID()));
    gl_.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                               sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                               buffer_offset(command.IdxOffset * sizeof(ImDrawIdx)),
                               static_cast<GLint>(command.VtxOffset));
  }
}

void ImGuiRenderer::upload(const ImDrawList& list) {
  gl_.BindVertexArray(vertex_array_.id());
  vertices_.upload(list.VtxBuffer.Data, list.VtxBuffer.Size * sizeof(ImDrawVert), GL_STREAM_DRAW);
  for (GLuint i = 0; i < 3; ++i) gl_.EnableVertexAttribArray(i);
  gl_.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(ImDrawVert),
                          buffer_offset(offsetof(ImDrawVert, pos)));
  gl_.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(ImDrawVert),
                          buffer_offset(offsetof(ImDrawVert, uv)));
  gl_.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(ImDrawVert),
                          buffer_offset(offsetof(ImDrawVert, col)));
  indices_.upload(list.IdxBuffer.Data, list.IdxBuffer.Size * sizeof(ImDrawIdx), GL_STREAM_DRAW);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
}

}  // namespace viete::platform
