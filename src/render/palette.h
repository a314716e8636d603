// Colour maps that are perceptually even and safe for colour-blind readers.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace viete::render {

/// For magnitudes on lit surfaces: blue over grey to yellow, lightness rising evenly and high enough for
/// shading to be read in it. `count` >= 2 colours as displayed.
std::vector<glm::vec3> surface_palette(int count = 256);

/// For what may be more or less than usual: blue over light grey to orange, the grey in the middle.
std::vector<glm::vec3> diverging_palette(int count = 256);

/// Colours interpolated evenly in Oklab (B. Ottosson, 2020, "A perceptual color space for image processing").
/// keys: at least 2, as displayed.
std::vector<glm::vec3> blend_palette(const std::vector<glm::vec3>& keys, int count);

}  // namespace viete::render
