#include "ui/overlay_painter.h"

#include <vector>

namespace viete::ui {

namespace {

constexpr float halo_width = 1.25f;  // in logical pixels, on each side

const ImVec2* as_imgui(std::span<const glm::vec2> points) {
  static_assert(sizeof(glm::vec2) == sizeof(ImVec2));
  return reinterpret_cast<const ImVec2*>(points.data());
}

}  // namespace

ImU32 faded(ImU32 color, float opacity) {
  const auto alpha = static_cast<ImU32>(static_cast<float>(color >> 24) * opacity + 0.5f);
  return (color & 0x00ffffff) | alpha << 24;
}

OverlayPainter::OverlayPainter(const Context& ui) : ui_(ui), list_(*ImGui::GetBackgroundDrawList()) {
  list_._FringeScale = 1 / ImGui::GetIO().DisplayFramebufferScale.x;
}

OverlayPainter::~OverlayPainter() {
  list_._FringeScale = 1;
}

ImU32 OverlayPainter::halo(ImU32 color, float opacity) const {
  return faded(ui_.colors.halo, opacity * static_cast<float>(color >> 24) / 255);
}

void OverlayPainter::stroke(std::span<const glm::vec2> points, ImU32 color, float width, bool closed) {
  list_.AddPolyline(as_imgui(points), static_cast<int>(points.size()), color, closed ? ImDrawFlags_Closed : 0,
                    width);
}

void OverlayPainter::line(std::span<const glm::vec2> points, ImU32 color, float width, bool closed,
                          float opacity) {
  stroke(points, halo(color, opacity), width + 2 * halo_width, closed);
  stroke(points, faded(color, opacity), width, closed);
}

void OverlayPainter::line(const glm::vec2& a, const glm::vec2& b, ImU32 color, float width, float opacity) {
  const std::array points{a, b};
  line(points, color, width, false, opacity);
}

void OverlayPainter::circle(const glm::vec2& center, float radius, ImU32 color, float width, float opacity) {
  list_.AddCircle(vec(center), radius, halo(color, opacity), 0, width + 2 * halo_width);
  list_.AddCircle(vec(center), radius, faded(color, opacity), 0, width);
}

void OverlayPainter::disc(const glm::vec2& center, float radius, ImU32 color, float opacity) {
  list_.AddCircleFilled(vec(center), radius + halo_width, halo(color, opacity));
  list_.AddCircleFilled(vec(center), radius, faded(color, opacity));
}

void OverlayPainter::polygon(std::span<const glm::vec2> corners, ImU32 color, float opacity) {
  stroke(corners, halo(color, opacity), 2 * halo_width, true);
  tint(corners, faded(color, opacity));
}

// ImGui antialiases the outer edges only of clockwise polygons. On the screen, y points down.
void OverlayPainter::tint(std::span<const glm::vec2> corners, ImU32 color) {
  float area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    area += a.x * b.y - a.y * b.x;
  }
  std::vector<glm::vec2> clockwise(corners.begin(), corners.end());
  if (area < 0) clockwise.assign(corners.rbegin(), corners.rend());
  list_.AddConvexPolyFilled(as_imgui(clockwise), static_cast<int>(clockwise.size()), color);
}

void OverlayPainter::outline(std::span<const glm::vec2> corners, ImU32 color) {
  stroke(corners, color, 1.25f, true);
}

// Draws triangles without antialiasing, because antialiased edges would be visible as rays.
void OverlayPainter::fan(const glm::vec2& center, std::span<const glm::vec2> line, ImU32 color) {
  const ImDrawListFlags flags = list_.Flags;
  list_.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    list_.AddTriangleFilled(vec(center), vec(line[i]), vec(line[i + 1]), color);
  }
  list_.Flags = flags;
}

void OverlayPainter::letter(const glm::vec2& center, const char* text, ImU32 color, float size) {
  ImFont* font = ui_.fonts.strong;
  const ImVec2 extent = font->CalcTextSizeA(size, 1e9f, 0, text);
  list_.AddText(font, size, {center.x - 0.5f * extent.x, center.y - 0.5f * extent.y}, color, text);
}

namespace {

ImU32 darkened(ImU32 color, float tone) {
  const ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
  return ImGui::ColorConvertFloat4ToU32({tone * c.x, tone * c.y, tone * c.z, c.w});
}

// Draws a shape; its points are relative to `corner`.
void draw_shape(const Context& ui, ImVec2 corner, const workspace::PictureShape& shape) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  std::vector<ImVec2> points;
  for (const glm::vec2& p : shape.points) points.push_back({corner.x + p.x, corner.y + p.y});
  const auto count = static_cast<int>(points.size());
  const ImU32 color = darkened(ui.colors.model, shape.tone);
  if (shape.triangles.empty()) {
    list.AddConvexPolyFilled(points.data(), count, color);
  } else {
    list.PrimReserve(static_cast<int>(3 * shape.triangles.size()), count);
    for (const auto& t : shape.triangles)
      for (const auto i : t) list.PrimWriteIdx(static_cast<ImDrawIdx>(list._VtxCurrentIdx + i));
    for (const ImVec2& p : points) list.PrimWriteVtx(p, ImGui::GetFontTexUvWhitePixel(), color);
  }
  if (!shape.outlined) return;
  const ImU32 edge = faded(darkened(ui.colors.model, 0.5f), 0.45f);
  list.AddPolyline(points.data(), count, edge, ImDrawFlags_Closed, 1);
}

}  // namespace

void draw_picture(const Context& ui, ImVec2 low, std::span<const workspace::PictureShape> shapes) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(low, {low.x + workspace::pose_picture_size.x, low.y + workspace::pose_picture_size.y},
                    true);
  list._FringeScale = 1 / ImGui::GetIO().DisplayFramebufferScale.x;
  for (const workspace::PictureShape& shape : shapes) draw_shape(ui, low, shape);
  list._FringeScale = 1;
  list.PopClipRect();
}

}  // namespace viete::ui
