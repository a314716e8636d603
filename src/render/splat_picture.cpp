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
  int skip = 0;  // if the pixel is complete: the distance to a later pixel; those between are complete
};

// Some rows of the picture.
class Band {
public:
  Band(int low, int high, int width)
      : low_(low),
        width_(width),
        open_((high - low) * width),
        pixels_(static_cast<std::size_t>((high - low) * stride())) {}

  bool is_complete() const { return open_ == 0; }
  std::span<const Pixel> row(int y) const {
    return std::span(pixels_).subspan(static_cast<std::size_t>((y - low_) * stride()),
                                      static_cast<std::size_t>(width_));
  }

  // Adds the splat to the row y.
  void add(const Spread& splat, int y, const Falloff& falloff) {
    const float dy = static_cast<float>(y) + 0.5F - splat.center.y, of_y = splat.square_y * dy * dy;
    if (of_y >= splat.limit) return;
    Pixel* row = &pixels_[static_cast<std::size_t>((y - low_) * stride())];
    const float middle = splat.center.x + splat.slant * dy;
    const float half = std::sqrt((splat.limit - of_y) / splat.square_x);
    const int end = first_pixel(middle + half, width_);
    for (int x = open_pixel(row, first_pixel(middle - half, width_)); x < end; x = open_pixel(row, x + 1)) {
      const float dx = static_cast<float>(x) + 0.5F - middle;
      const float square = std::min(splat.square_x * dx * dx + of_y, splat.limit);
      row[x].add(std::min(0.99F, splat.opacity * falloff(square)), splat.color, splat.depth);
      if (row[x].through >= least_through) continue;
      row[x].skip = 1;
      --open_;
    }
  }

private:
  int stride() const { return width_ + 1; }  // a row ends with a pixel that is never complete
  // Returns the first pixel from x on that is not complete, in nearly constant time.
  static int open_pixel(Pixel* row, int x) {
    int at = x;
    while (row[at].skip > 0) at += row[at].skip;
    if (at > x) row[x].skip = at - x;
    return at;
  }

  int low_, width_, open_;
  std::vector<Pixel> pixels_;
};

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
  Band band(low, high, size_.x);
  for (std::size_t i = 0; i < ellipses.size() && !band.is_complete(); ++i) {
    const int begin = std::max(rows_[i].low, low), end = std::min(rows_[i].high, high);
    if (begin >= end) continue;
    const Spread splat(ellipses[i], size_);
    for (int y = begin; y < end; ++y) band.add(splat, y, falloff);
  }
  std::size_t at = static_cast<std::size_t>(low) * static_cast<std::size_t>(size_.x);
  for (int y = low; y < high; ++y)
    for (const Pixel& pixel : band.row(y)) {
      const glm::vec4 shown = 255.0F * glm::min(glm::vec4(pixel.color, 1 - pixel.through), 1.0F) + 0.5F;
      for (int k = 0; k < 4; ++k)
        colors_[at][static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(shown[k]);
      depths_[at++] = pixel.depth;
    }
}

}  // namespace viete::render
