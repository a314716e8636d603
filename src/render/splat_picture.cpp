#include "render/splat_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/worker_pool.h"

namespace viete::render {

namespace {

constexpr int rows_per_band = 32;
constexpr float least_through = 1.0F / 512;  // pixels with less remaining transparency are complete

// The first pixel whose middle is at or after `at`, limited to [0, count].
int first_pixel(float at, int count) {
  return static_cast<int>(std::clamp(std::ceil(at - 0.5F), 0.0F, static_cast<float>(count)));
}

// The values exp(-x / 2) for 0 <= x <= reach^2.
class Falloff {
public:
  Falloff() {
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] = std::exp(-0.5F * (static_cast<float>(i) + 0.5F) / per_unit_);
  }
  float operator()(float x) const { return values_[static_cast<std::size_t>(x * per_unit_)]; }

private:
  static constexpr std::size_t steps_ = 4096;
  static constexpr float per_unit_ = static_cast<float>(steps_) / (Ellipse::reach * Ellipse::reach);
  std::array<float, steps_ + 2> values_;
};

// The ellipse in pixels. Its points (x, y) fulfil square_x (x - slant y)^2 + square_y y^2 <= limit.
struct Spread {
  Spread(const Ellipse& e, glm::ivec2 size)
      : center(0.5F * (glm::vec2(e.center[0], e.center[1]) + 1.0F) * glm::vec2(size)),
        color(Ellipse::brightest / 65535 * glm::vec3(e.red, e.green, e.blue)),
        depth(0.5F + 0.5F * e.center[2]),
        opacity(static_cast<float>(e.opacity) / 65535) {
    const float x = e.long_axis[0], y = e.long_axis[1], length = std::sqrt(x * x + y * y),
                ratio = e.short_axis / length;
    const float xy = x * y * (1 - ratio * ratio), yy = y * y + ratio * ratio * x * x;
    slant = xy / yy;
    square_y = 1 / yy;
    square_x = yy / (length * length * e.short_axis * e.short_axis);
    limit = std::min(Ellipse::reach * Ellipse::reach, 2 * std::log(std::max(255 * opacity, 1.0F)));
  }

  glm::vec2 center;
  glm::vec3 color;
  float depth;  // in the window, 0 to 1
  float opacity, slant, square_x, square_y, limit;
};

struct Pixel {
  // Adds a splat behind the splats so far.
  void add(float opacity, const glm::vec3& of_splat, float depth_of_splat) {
    const float share = through * opacity, rest = through - share;
    if (through == 1 || (through >= 0.5F && rest < 0.5F)) depth = depth_of_splat;
    color += share * of_splat;
    through = rest;
  }

  glm::vec3 color{0};
  float through = 1;  // transparency
  float depth = 1;
};

// Adds the splat to a row of pixels. `dy` is the distance of the row from the centre of the splat.
void add(const Spread& splat, float dy, std::span<Pixel> row, const Falloff& falloff) {
  const float of_y = splat.square_y * dy * dy;
  if (of_y >= splat.limit) return;
  const auto width = static_cast<int>(row.size());
  const float middle = splat.center.x + splat.slant * dy;
  const float half = std::sqrt((splat.limit - of_y) / splat.square_x);
  const int end = first_pixel(middle + half, width);
  for (int x = first_pixel(middle - half, width); x < end; ++x) {
    Pixel& pixel = row[static_cast<std::size_t>(x)];
    if (pixel.through < least_through) continue;
    const float dx = static_cast<float>(x) + 0.5F - middle;
    const float square = std::min(splat.square_x * dx * dx + of_y, splat.limit);
    pixel.add(std::min(0.99F, splat.opacity * falloff(square)), splat.color, splat.depth);
  }
}

}  // namespace

void SplatPicture::blend(std::span<const Ellipse> ellipses, glm::ivec2 size) {
  size_ = size;
  rows_.resize(ellipses.size());
  base::for_blocks(ellipses.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Spread spread(ellipses[i], size);
      const float half = std::sqrt(spread.limit / spread.square_y);
      rows_[i] = {first_pixel(spread.center.y - half, size.y), first_pixel(spread.center.y + half, size.y)};
    }
  });
  colors_.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  depths_.resize(colors_.size());
  const auto bands = static_cast<std::size_t>((size.y + rows_per_band - 1) / rows_per_band);
  base::for_blocks(
      bands,
      [&](std::size_t begin, std::size_t end) {
        for (auto band = static_cast<int>(begin); band < static_cast<int>(end); ++band)
          blend_band(ellipses, band * rows_per_band, std::min((band + 1) * rows_per_band, size.y));
      },
      1);
}

void SplatPicture::blend_band(std::span<const Ellipse> ellipses, int low, int high) {
  static const Falloff falloff;
  const auto width = static_cast<std::size_t>(size_.x);
  std::vector<Pixel> pixels(static_cast<std::size_t>(high - low) * width);
  for (std::size_t i = 0; i < ellipses.size(); ++i) {
    const int begin = std::max(rows_[i].low, low), end = std::min(rows_[i].high, high);
    if (begin >= end) continue;
    const Spread splat(ellipses[i], size_);
    for (int y = begin; y < end; ++y)
      add(splat, static_cast<float>(y) + 0.5F - splat.center.y,
          std::span(pixels).subspan(static_cast<std::size_t>(y - low) * width, width), falloff);
  }
  const std::size_t first = static_cast<std::size_t>(low) * width;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const glm::vec4 shown = 255.0F * glm::min(glm::vec4(pixels[i].color, 1 - pixels[i].through), 1.0F) + 0.5F;
    for (int k = 0; k < 4; ++k)
      colors_[first + i][static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(shown[k]);
    depths_[first + i] = pixels[i].depth;
  }
}

}  // namespace viete::render
