// View of the scene: camera matrices, size in pixels, and theme colours.
//
// Drawing of one frame (in this order; every layer is optional):
//
//   framebuffer.begin(view.size, samples);         // our own target, cleared
//   backdrop.draw(theme);                          // background gradient
//   surface.draw(view, theme, surface_style);      // the model, lit
//   shadow.draw(view, theme, shadow_style);        // of the model on the ground
//   grid.draw(view, theme, grid_style);            // ground grid, behind and below the model
//   faces.draw(view, face_style);                  // tinted; they hide later layers behind them
//   lines.draw(view, line_style);                  // hidden parts faint, visible parts full
//   discs.draw(view, disc_style);
//   framebuffer.resolve();                         // samples -> pixels; the resolved picture is now bound
//   whole.begin_with(framebuffer, size);           // a second target keeps the view while panels change
//   imgui_renderer.draw(*ImGui::GetDrawData());    // panels, after the resolve
//   whole.blit_to_window(window_size);             // or: Image image = whole.read();
//
// Every draw() sets the GL state that it needs, and leaves blending, depth test and scissor off and depth
// writes on. Data change at three rates: topology (set_triangles, set_segments), looks (set_colors,
// set_discs), positions (set_positions, every frame, no allocation while the count stays the same).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/vector.h"

namespace viete::render {

/// A point or direction in world space.
using Point = base::Vec3;
using Triangle = std::array<std::uint32_t, 3>;

/// Double precision until the last step: vertices are stored relative to one of them, which avoids jitter far
/// from the origin. Converts to glm::mat4 implicitly.
struct View {
  glm::dmat4 view{1};        ///< world to eye: right-handed, looking down -z
  glm::dmat4 projection{1};  ///< eye to clip space, depth -1 to 1 as glm::perspective and glm::ortho make it
  glm::ivec2 size{1, 1};     ///< device pixels
  float scale = 1;           ///< device pixels per logical pixel; widths and radii below are logical
  friend bool operator==(const View&, const View&) = default;
};

/// World to eye matrix for vertices stored relative to `origin`.
glm::mat4 eye_matrix(const View& view, const Point& origin);

/// Factor (x, y) and offset (z, w) that map device pixels (origin bottom left) to the view ray: (factor *
/// pixel + offset, -1) in eye space. For an orthographic view the ray is (0, 0, -1) everywhere.
glm::vec4 eye_ray(const View& view);

/// A colour from 0xRRGGBB, components 0 to 1 as displayed (sRGB).
constexpr glm::vec3 rgb(std::uint32_t hex) {
  return {static_cast<float>(hex >> 16 & 255) / 255.0F, static_cast<float>(hex >> 8 & 255) / 255.0F,
          static_cast<float>(hex & 255) / 255.0F};
}

/// Colours as displayed (sRGB, 0 to 1).
struct Theme {
  glm::vec3 background_top, background_bottom;
  glm::vec3 grid;       ///< ground lines
  glm::vec3 model;      ///< the surface in full light
  glm::vec3 held;       ///< vertices that stay at rest
  glm::vec3 wire;       ///< triangle edges on the surface
  glm::vec3 cage;       ///< cage lines and vertices at rest
  glm::vec3 selection;  ///< selected elements
  glm::vec3 hover;      ///< the ring under the cursor
  glm::vec3 finding;    ///< problems found by checks
  glm::vec3 outline;    ///< thin edge around discs, for contrast
  glm::vec4 halo;       ///< thin edge around lines, with its opacity
  glm::vec4 shadow;     ///< ground shadow, with its largest opacity
  float exposure;       ///< brightness of the lights, 1 = neutral
};

Theme dark_theme();
Theme light_theme();
inline Theme theme(bool dark) {
  return dark ? dark_theme() : light_theme();
}

// Colour maps, perceptually uniform and safe for colour-blind readers.

/// Linear light of a display value.
float linear_light(float display);

/// For magnitudes on lit surfaces: blue over grey to yellow, with uniformly rising lightness, bright enough
/// to show shading. `count` >= 2 colours as displayed.
std::vector<glm::vec3> surface_palette(int count = 256);

/// For signed values: blue over light grey to orange, with grey in the middle.
std::vector<glm::vec3> diverging_palette(int count = 256);

/// Interpolates colours uniformly in Oklab (B. Ottosson, 2020, "A perceptual color space for image
/// processing"). keys: at least 2, as displayed.
std::vector<glm::vec3> blend_palette(const std::vector<glm::vec3>& keys, int count);

}  // namespace viete::render
