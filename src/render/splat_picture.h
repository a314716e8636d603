// Blends splats on the processor: several times faster than a software rasteriser.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/image.h"

namespace viete::render {

/// A splat on the screen, in the layout of the shader.
struct alignas(16) Ellipse {
  static constexpr float brightest = 4;
  static constexpr float reach = 3;  ///< in standard deviations; a splat ends there

  float center[3];              ///< in normalized device coordinates
  std::uint16_t red, green;     ///< in units of brightest / 65535
  float long_axis[2];           ///< the longer standard deviation and its direction, in pixels
  float short_axis;             ///< the shorter standard deviation, in pixels
  std::uint16_t blue, opacity;  ///< opacity in units of 1 / 65535
};

/// A picture of splats, bottom row first.
class SplatPicture {
public:
  /// Blends ellipses from front to back. A pixel ends when it is nearly opaque.
  void blend(std::span<const Ellipse> ellipses, glm::ivec2 size);

  const std::vector<Rgba8>& colors() const { return colors_; }  ///< premultiplied by the opacity
  /// The window depth at which the opacity reaches a half; if it stays below, of the nearest splat.
  const std::vector<float>& depths() const { return depths_; }

private:
  struct Rows {
    int low, high;  // the first row, and the row after the last
  };
  void blend_band(std::span<const Ellipse> ellipses, int low, int high);

  glm::ivec2 size_{0, 0};
  std::vector<Rgba8> colors_;
  std::vector<float> depths_;
  std::vector<Rows> rows_;  // one per ellipse
};

}  // namespace viete::render
