// Lines and shapes over the view, behind the panels: each with a thin halo, so that it shows on any
// background.
#pragma once

#include <array>
#include <span>

#include "ui/context.h"

namespace viete::ui {

/// A colour with its opacity multiplied.
ImU32 faded(ImU32 color, float opacity);

inline ImVec2 vec(const glm::vec2& p) {
  return {p.x, p.y};
}

inline std::array<glm::vec2, 4> square(const glm::vec2& center, float half) {
  return {center + glm::vec2(-half, -half), center + glm::vec2(half, -half), center + glm::vec2(half, half),
          center + glm::vec2(-half, half)};
}

/// Draws into ImGui's background list, with edges as sharp as the screen's pixels at any scale.
class OverlayPainter {
public:
  explicit OverlayPainter(const Context& ui);
  ~OverlayPainter();
  OverlayPainter(const OverlayPainter&) = delete;
  OverlayPainter& operator=(const OverlayPainter&) = delete;

  /// opacity applies to colour and halo.
  void line(std::span<const glm::vec2> points, ImU32 color, float width, bool closed = false,
            float opacity = 1);
  void line(const glm::vec2& a, const glm::vec2& b, ImU32 color, float width, float opacity = 1);
  void circle(const glm::vec2& center, float radius, ImU32 color, float width, float opacity = 1);
  void disc(const glm::vec2& center, float radius, ImU32 color, float opacity = 1);
  /// Convex.
  void polygon(std::span<const glm::vec2> corners, ImU32 color, float opacity = 1);
  /// The same without halo: a tint of what is below.
  void tint(std::span<const glm::vec2> corners, ImU32 color);
  /// A thin line around it, without halo either.
  void outline(std::span<const glm::vec2> corners, ImU32 color);
  /// A tint between the centre and a line, which may go all the way round.
  void fan(const glm::vec2& center, std::span<const glm::vec2> line, ImU32 color);
  /// One letter or word in the middle of a place.
  void letter(const glm::vec2& center, const char* text, ImU32 color, float size = 13);

private:
  ImU32 halo(ImU32 color, float opacity) const;
  void stroke(std::span<const glm::vec2> points, ImU32 color, float width, bool closed);

  const Context& ui_;
  ImDrawList& list_;
};

}  // namespace viete::ui
