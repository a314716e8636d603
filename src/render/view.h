// The camera matrices, size and colours of a picture.
//
// To draw one frame, call the following functions in this order. Every layer is optional.
//
//   framebuffer.begin(view.size, samples);
//   backdrop.draw(theme);                          // background gradient
//   surface.draw(view, theme, surface_style);      // the model
//   splats.draw(view, surface_style);              // the model, if it is a capture: after shadow and grid
//   shadow.draw(view, theme, shadow_style);        // the shadow of the model on the ground
//   grid.draw(view, theme, grid_style);            // ground grid
//   faces.draw(view, face_style);                  // cage faces
//   lines.draw(view, line_style);                  // cage edges
//   discs.draw(view, disc_style);                  // cage vertices
//   framebuffer.resolve();
//   whole.begin_with(framebuffer, size);           // copies the picture to a second target, `whole`
//   imgui_renderer.draw(*ImGui::GetDrawData());    // panels
//   whole.blit_to_window(window_size);             // or: Image image = whole.read();
//
// Every draw() sets the GL state that it needs. At its end, blending, depth test and scissor are off, and
// depth writes are on. set_positions() does not allocate memory while the number of points stays the same.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/vector.h"

namespace viete::render {

/// A point or a direction in world space.
using Point = base::Vec3;
using Triangle = std::array<std::uint32_t, 3>;

/// The matrices and size of a view. The matrices are doubles, to avoid jitter far from the origin.
struct View {
  glm::dmat4 view{1};        ///< from world to eye space, right-handed, looking along -z
  glm::dmat4 projection{1};  ///< from eye to clip space (depth -1 to 1), like glm::perspective
  glm::ivec2 size{1, 1};     ///< in device pixels
  float scale = 1;           ///< device pixels per logical pixel
  friend bool operator==(const View&, const View&) = default;
};

/// Returns the matrix to eye space for vertices that are stored relative to `origin`.
glm::mat4 eye_matrix(const View& view, const Point& origin);

/// Returns (factor x, factor y, offset x, offset y) for shaders. The view ray of a device pixel, counted from
/// the bottom left, is (factor * pixel + offset, -1) in eye space. In an orthographic view, all four are 0.
glm::vec4 eye_ray(const View& view);

/// Returns the colour 0xRRGGBB with components from 0 to 1, as displayed (sRGB).
constexpr glm::vec3 rgb(std::uint32_t hex) {
  return {static_cast<float>(hex >> 16 & 255) / 255.0F, static_cast<float>(hex >> 8 & 255) / 255.0F,
          static_cast<float>(hex & 255) / 255.0F};
}

/// Colours, as displayed (sRGB, from 0 to 1).
struct Theme {
  glm::vec3 background_top, background_bottom;
  glm::vec3 grid;
  glm::vec3 model;      ///< the surface in full light
  glm::vec3 held;       ///< vertices that stay at rest
  glm::vec3 wire;       ///< triangle edges on the surface
  glm::vec3 cage;       ///< unselected cage edges and vertices
  glm::vec3 selection;  ///< selected elements
  glm::vec3 hover;      ///< the ring around the hovered point
  glm::vec3 finding;    ///< problems that checks found
  glm::vec3 outline;    ///< the thin edge around discs
  glm::vec4 halo;       ///< the thin edge around lines, with opacity
  glm::vec4 shadow;     ///< the ground shadow, with its largest opacity
  float exposure;       ///< the brightness of the lights; 1 is normal
};

Theme theme(bool dark);

/// Converts an sRGB component to linear light, both in [0, 1].
float linear_light(float display);

// The palettes have `count` >= 2 colours, as displayed. Colour-blind people can distinguish the colours.

/// For positive values: from blue through grey to yellow, with increasing lightness. All colours are light
/// enough to show the shading.
std::vector<glm::vec3> surface_palette(int count = 256);

/// For signed values: from blue through light grey to orange.
std::vector<glm::vec3> diverging_palette(int count = 256);

/// Interpolates between the colours `keys` in Oklab. Requires at least 2 keys, as displayed. Source: B.
/// Ottosson, 2020, "A perceptual color space for image processing".
std::vector<glm::vec3> blend_palette(const std::vector<glm::vec3>& keys, int count);

}  // namespace viete::render
