// Colour maps that are perceptually even and safe for colour-blind readers.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace viete::render {

/// For magnitudes: dark blue over grey to yellow, lightness rising evenly. `count` >= 2 colours as displayed.
std::vector<glm::vec3> sequential_palette(int count = 256);

/// For magnitudes on lit surfaces: the same from a lighter blue, so that shading can still be read in it.
std::vector<glm::vec3> surface_palette(int count = 256);

/// For values around a meaningful zero in the middle: blue, white, orange. `count` >= 2 colours as displayed.
std::vector<glm::vec3> diverging_palette(int count = 257);

/// Colours interpolated evenly in Oklab (B. Ottosson, 2020, "A perceptual color space for image processing").
/// keys: at least 2, as displayed.
std::vector<glm::vec3> blend_palette(const std::vector<glm::vec3>& keys, int count);

}  // namespace viete::render
