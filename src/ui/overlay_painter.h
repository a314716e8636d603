// Draws lines and shapes over the view and behind the panels. A thin halo gives contrast on any background.
#pragma once

#include <array>
#include <span>

#include "ui/context.h"
#include "workspace/pose_picture.h"

namespace viete::ui {

/// The colour with its opacity multiplied by `opacity`.
ImU32 faded(ImU32 color, float opacity);

inline ImVec2 vec(const glm::vec2& p) {
  return {p.x, p.y};
}

inline std::array<glm::vec2, 4> square(const glm::vec2& center, float half) {
  return {center + glm::vec2(-half, -half), center + glm::vec2(half, -half), center + glm::vec2(half, half),
          center + glm::vec2(-half, half)};
}

/// Draws a thumbnail of pose_picture_size into the current window. `low` is its upper left corner.
void draw_picture(const Context& ui, ImVec2 low, std::span<const workspace::PictureShape> shapes);

/// Draws icons in coordinates from -1 to 1 around `middle`.
struct Pen {
  ImDrawList& draw;
  ImVec2 middle;
  ImU32 color;
  float radius;

  ImVec2 at(float x, float y) const { return {middle.x + radius * x, middle.y + radius * y}; }
  void line(float x0, float y0, float x1, float y1) const {
    draw.AddLine(at(x0, y0), at(x1, y1), color, 1.5f);
  }
};

/// Draws into ImGui's background list. Edges are sharp at any display scale.
class OverlayPainter {
public:
  explicit OverlayPainter(const Context& ui);
  ~OverlayPainter();
  OverlayPainter(const OverlayPainter&) = delete;
  OverlayPainter& operator=(const OverlayPainter&) = delete;

  /// `opacity` applies to the colour and to the halo.
  void line(std::span<const glm::vec2> points, ImU32 color, float width, bool closed = false,
            float opacity = 1);
  void line(const glm::vec2& a, const glm::vec2& b, ImU32 color, float width, float opacity = 1);
  void circle(const glm::vec2& center, float radius, ImU32 color, float width, float opacity = 1);
  void disc(const glm::vec2& center, float radius, ImU32 color, float opacity = 1);
  /// Filled convex polygon.
  void polygon(std::span<const glm::vec2> corners, ImU32 color, float opacity = 1);
  /// Filled polygon without halo, to tint the background.
  void tint(std::span<const glm::vec2> corners, ImU32 color);
  /// Thin closed line without halo.
  void outline(std::span<const glm::vec2> corners, ImU32 color);
  /// Tinted fan of triangles between the centre and a line.
  void fan(const glm::vec2& center, std::span<const glm::vec2> line, ImU32 color);
  /// Centred text, a letter or a word.
  void letter(const glm::vec2& center, const char* text, ImU32 color, float size = 13);

private:
  ImU32 halo(ImU32 color, float opacity) const;
  void stroke(std::span<const glm::vec2> points, ImU32 color, float width, bool closed);

  const Context& ui_;
  ImDrawList& list_;
};

}  // namespace viete::ui
