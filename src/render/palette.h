// Perceptually uniform colour maps that are safe for colour-blind readers.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace viete::render {

/// For magnitudes on lit surfaces: blue over grey to yellow, with uniformly rising lightness, bright enough
/// to show shading. `count` >= 2 colours as displayed.
std::vector<glm::vec3> surface_palette(int count = 256);

/// For signed values: blue over light grey to orange, with grey in the middle.
std::vector<glm::vec3> diverging_palette(int count = 256);

/// Interpolates colours uniformly in Oklab (B. Ottosson, 2020, "A perceptual color space for image
/// processing"). keys: at least 2, as displayed.
std::vector<glm::vec3> blend_palette(const std::vector<glm::vec3>& keys, int count);

}  // namespace viete::render
