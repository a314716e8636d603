#include "render/splat_layer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "base/error.h"
#include "base/spherical_harmonics.h"
#include "base/worker_pool.h"
#include "render/upload.h"

namespace viete::render {

namespace {

constexpr float least_opacity = 1.0F / 255;
constexpr float blur = 0.3F;            // added to both variances on the screen, in squared pixels
constexpr float widest = 1.3F;          // outside the picture, in its half size, Jacobians stay constant
constexpr float most_deviation = 1e5F;  // in pixels; larger ones could not be squared, and fill the view
constexpr std::size_t block = 1 << 13;

// R^T d, where R is the rotation of the quaternion.
glm::vec3 turned_back(const SplatTurn& turn, const glm::vec3& d) {
  const glm::vec3 u(-turn[1], -turn[2], -turn[3]), twice = 2.0F * glm::cross(u, d);
  return d + turn[0] * twice + glm::cross(u, twice);
}

std::uint16_t stored(float value, float most) {
  return static_cast<std::uint16_t>(value > 0 ? 65535 * std::min(value / most, 1.0F) + 0.5F : 0);  // NaN: 0
}

template <class T>
void copy(std::span<const T> from, std::vector<T>& to) {
  to.resize(from.size());
  base::for_blocks(from.size(), [&](std::size_t begin, std::size_t end) {
    std::copy(from.begin() + begin, from.begin() + end, to.begin() + static_cast<std::ptrdiff_t>(begin));
  });
}

// The bits of floats as integers in the opposite order.
std::uint32_t key_of(float depth) {
  const auto bits = std::bit_cast<std::uint32_t>(depth);
  return bits >> 31 != 0 ? bits : ~bits & 0x7fffffffU;
}

}  // namespace

void sort_back_to_front(std::span<const float> depths, std::vector<std::uint32_t>& order) {
  constexpr int passes = 3, bits = 11;
  constexpr std::uint32_t most = (1U << bits) - 1;
  struct Item {
    std::uint32_t key, index;
  };
  std::vector<Item> items(depths.size()), sorted(depths.size());
  std::array<std::array<std::uint32_t, most + 1>, passes> places{};
  for (std::uint32_t i = 0; i < depths.size(); ++i) {
    items[i] = {key_of(depths[i]), i};
    for (int pass = 0; pass < passes; ++pass) ++places[pass][items[i].key >> (pass * bits) & most];
  }
  for (int pass = 0; pass < passes; ++pass) {
    std::uint32_t sum = 0;
    for (std::uint32_t& place : places[pass]) sum += std::exchange(place, sum);
    for (const Item& item : items) sorted[places[pass][item.key >> (pass * bits) & most]++] = item;
    items.swap(sorted);
  }
  order.resize(items.size());
  std::transform(items.begin(), items.end(), order.begin(), [](const Item& item) { return item.index; });
}

// The input of a projection that all splats share, for positions relative to the origin.
struct SplatLayer::Frame {
  Frame(const Drawn& input, const Point& origin)
      : drawn(input), grow(std::sqrt(static_cast<float>(input.step))) {
    const View& view = input.view;
    const glm::dvec3 from(origin[0], origin[1], origin[2]);
    const glm::dmat4 rows = glm::transpose(view.projection * glm::translate(view.view, from));
    for (int i = 0; i < 4; ++i) clip[i] = glm::vec4(rows[i]);
    depth = -glm::vec4(glm::transpose(glm::translate(view.view, from))[2]);
    const glm::dmat4 back = glm::inverse(view.view);
    perspective = view.projection[3][3] == 0;
    eye =
        perspective ? glm::vec3(glm::dvec3(back[3]) - from) : -glm::vec3(glm::normalize(glm::dvec3(back[2])));
    half = 0.5F * glm::vec2(view.size);
  }

  Drawn drawn;
  float grow;         // factor of the size of splats
  glm::vec4 clip[4];  // rows of the matrix to clip space
  glm::vec4 depth;    // row for the distance from the eye along the view
  bool perspective;
  glm::vec3 eye;   // the position of the eye; in an orthographic view, the direction of the view
  glm::vec2 half;  // half the size of the picture in pixels
};

SplatLayer::SplatLayer(const Gl& gl)
    : gl_(gl),
      blended_(gl, gl.software ? "splat_picture" : "splat"),
      solid_(gl, gl.software ? "splat_picture" : "splat", "#define SOLID\n"),
      vertex_array_(gl),
      ellipses_(gl, GL_RGBA32UI),
      palette_{glm::vec3(0), glm::vec3(1)},
      colors_(gl),
      picture_depths_(gl) {}

void SplatLayer::set_looks(std::shared_ptr<const SplatLooks> looks) {
  looks_ = std::move(looks);
  if (looks_) {
    require_texels(gl_, "splats", 2 * size());
    require_count("colours of splats", looks_->colors.size(), size());
    const auto bands = static_cast<std::size_t>(looks_->degree * (looks_->degree + 2));
    if (bands > 0) require_count("harmonics of splats", looks_->harmonics->size(), 3 * bands * size());
  }
  vertices_.clear();
  scalars_.clear();
}

void SplatLayer::set_splats(std::span<const SurfaceVertex> vertices, const Point& origin,
                            std::span<const SplatShape> shapes, std::span<const SplatTurn> turns) {
  require_count("splats", vertices.size(), size());
  require_count("shapes of splats", shapes.size(), size());
  if (!turns.empty()) require_count("turns of splats", turns.size(), size());
  copy(vertices, vertices_);
  copy(shapes, shapes_);
  copy(turns, turns_);
  origin_ = origin;
  drawn_.reset();
}

void SplatLayer::set_scalars(std::span<const float> scalars) {
  if (!scalars.empty()) require_count("scalars of splats", scalars.size(), size());
  scalars_.assign(scalars.begin(), scalars.end());
  drawn_.reset();
}

void SplatLayer::set_palette(std::span<const glm::vec3> colors) {
  if (colors.size() < 2) throw base::Error("palette", "has fewer than 2 colours");
  palette_.assign(colors.begin(), colors.end());
  drawn_.reset();
}

glm::vec3 SplatLayer::color_of(const Frame& frame, std::size_t splat) const {
  const std::array<float, 3>& constant = looks_->colors[splat];
  glm::vec3 color(constant[0], constant[1], constant[2]);
  const auto bands = static_cast<std::size_t>(looks_->degree * (looks_->degree + 2));
  if (bands > 0) {
    const float* p = vertices_[splat].position;
    const glm::vec3 d =
        frame.perspective ? glm::normalize(glm::vec3(p[0], p[1], p[2]) - frame.eye) : frame.eye;
    const glm::vec3 back = turns_.empty() ? d : turned_back(turns_[splat], d);
    const auto at = base::harmonics_at(back.x, back.y, back.z, looks_->degree);
    const float* factors = looks_->harmonics->data() + 3 * bands * splat;
    for (int channel = 0; channel < 3; ++channel, factors += bands)
      for (std::size_t i = 0; i < bands; ++i) color[channel] += factors[i] * at[i];
  }
  return frame.drawn.scalars ? map_color(frame, splat, glm::dot(color, glm::vec3(0.30F, 0.59F, 0.11F)))
                             : color;
}

// A map without any light and shade would show only an outline.
glm::vec3 SplatLayer::map_color(const Frame& frame, std::size_t splat, float brightness) const {
  const float range = frame.drawn.high - frame.drawn.low;
  const float share = range > 0 ? (scalars_[splat] - frame.drawn.low) / range : 0;
  const float at = share > 0 ? std::min(share, 1.0F) * static_cast<float>(palette_.size() - 1) : 0;
  const auto key = std::min(static_cast<std::size_t>(at), palette_.size() - 2);
  const float light = brightness > 0 ? std::min(1.5F * brightness, 1.0F) : 0;
  return (0.55F + 0.45F * light) * glm::mix(palette_[key], palette_[key + 1], at - static_cast<float>(key));
}

// Returns false if the splat is not visible.
bool SplatLayer::project(const Frame& frame, std::size_t splat, Ellipse& ellipse, float& depth) const {
  const float opacity = looks_->opacities[splat];
  if (!(opacity >= least_opacity)) return false;
  const float* position = vertices_[splat].position;
  const glm::vec4 p(position[0], position[1], position[2], 1);
  const float w = glm::dot(frame.clip[3], p);
  const glm::vec3 place =
      glm::vec3(glm::dot(frame.clip[0], p), glm::dot(frame.clip[1], p), glm::dot(frame.clip[2], p)) / w;
  depth = glm::dot(frame.depth, p);
  if (!(w > 0 && std::abs(place.z) <= 1 && std::isfinite(place.x) && std::isfinite(place.y) &&
        std::isfinite(depth)))
    return false;

  // The rows of the Jacobian of the projection times M. Their products are the covariance on the screen.
  const SplatShape& m = shapes_[splat];
  glm::vec3 rows[2];
  float largest = 0;
  bool finite = true;
  for (int i = 0; i < 2; ++i) {
    const glm::vec3 j =
        (frame.grow * frame.half[i] / w) *
        (glm::vec3(frame.clip[i]) - std::clamp(place[i], -widest, widest) * glm::vec3(frame.clip[3]));
    rows[i] = j.x * glm::vec3(m[0], m[1], m[2]) + j.y * glm::vec3(m[3], m[4], m[5]) +
              j.z * glm::vec3(m[6], m[7], m[8]);
    for (int k = 0; k < 3; ++k) {
      largest = std::max(largest, std::abs(rows[i][k]));
      finite = finite && std::isfinite(rows[i][k]);
    }
  }
  if (!finite) return false;
  if (largest > most_deviation)
    for (glm::vec3& row : rows) row *= most_deviation / largest;
  const float a = glm::dot(rows[0], rows[0]) + blur, b = glm::dot(rows[0], rows[1]),
              c = glm::dot(rows[1], rows[1]) + blur;
  const glm::vec2 reach = Ellipse::reach * glm::sqrt(glm::vec2(a, c)) / frame.half;
  if (std::abs(place.x) > 1 + reach.x || std::abs(place.y) > 1 + reach.y) return false;

  // The determinant without cancellation, for needles: the sum of the squared minors of the rows, and blur.
  const glm::vec3 minors = glm::cross(rows[0], rows[1]);
  const float determinant = glm::dot(minors, minors) + blur * (a + c - blur);
  const float variance = 0.5F * (a + c) + glm::length(glm::vec2(0.5F * (a - c), b));
  glm::vec2 axis = a >= c ? glm::vec2(variance - c, b) : glm::vec2(b, variance - a);
  const float length = glm::length(axis);
  axis = length > 0 ? axis / length : glm::vec2(1, 0);
  axis *= std::sqrt(variance);
  const glm::vec3 color = color_of(frame, splat);
  ellipse = {{place.x, place.y, place.z},
             stored(color.r, Ellipse::brightest),
             stored(color.g, Ellipse::brightest),
             {axis.x, axis.y},
             std::sqrt(determinant / variance),
             stored(color.b, Ellipse::brightest),
             stored(opacity, 1)};
  return true;
}

// Projects all splats in blocks, closes the gaps of invisible ones and sorts the rest.
void SplatLayer::project(const Drawn& drawn) {
  const Frame frame(drawn, origin_);
  const std::size_t count = (size() + drawn.step - 1) / drawn.step;
  projected_.resize(count);
  depths_.resize(count);
  std::vector<std::size_t> found((count + block - 1) / block);
  base::for_blocks(
      count,
      [&](std::size_t begin, std::size_t end) {
        std::size_t at = begin;
        for (std::size_t i = begin; i < end; ++i)
          if (project(frame, i * drawn.step, projected_[at], depths_[at])) ++at;
        found[begin / block] = at - begin;
      },
      block);
  visible_ = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto from = static_cast<std::ptrdiff_t>(i * block),
               to = from + static_cast<std::ptrdiff_t>(found[i]);
    std::copy(projected_.begin() + from, projected_.begin() + to,
              projected_.begin() + static_cast<std::ptrdiff_t>(visible_));
    std::copy(depths_.begin() + from, depths_.begin() + to,
              depths_.begin() + static_cast<std::ptrdiff_t>(visible_));
    visible_ += found[i];
  }
  sort_back_to_front(std::span(depths_).first(visible_), order_);
}

void SplatLayer::upload() {
  auto* mapped = static_cast<Ellipse*>(ellipses_.buffer.map(visible_ * sizeof(Ellipse)));
  base::for_blocks(visible_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) mapped[i] = projected_[order_[i]];
  });
  ellipses_.buffer.unmap();
}

void SplatLayer::blend(glm::ivec2 size) {
  front_to_back_.resize(visible_);
  base::for_blocks(visible_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) front_to_back_[i] = projected_[order_[visible_ - 1 - i]];
  });
  picture_.blend(front_to_back_, size);
  set_texture(gl_, 0, colors_, size.x, size.y, {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
              picture_.colors().data());
  set_texture(gl_, 1, picture_depths_, size.x, size.y, {GL_R32F, GL_RED, GL_FLOAT}, picture_.depths().data());
}

void SplatLayer::draw(const View& view, const SurfaceStyle& style, std::size_t step) {
  if (vertices_.empty()) return;
  const Drawn wanted{view, step, style.scalars && !scalars_.empty(), style.scalar_low, style.scalar_high};
  if (drawn_ != wanted) {
    project(wanted);
    if (gl_.software) {
      blend(view.size);
    } else if (visible_ > 0) {
      upload();
    }
    drawn_ = wanted;
  }
  if (visible_ == 0) return;
  if (gl_.software) {
    bind_texture(gl_, 0, colors_);
    bind_texture(gl_, 1, picture_depths_);
  } else {
    ellipses_.bind(2);
  }
  gl_.BindVertexArray(vertex_array_.id());
  const auto draw_all = [&](const Program& program) {
    program.use();
    program.set("ellipses", 2);
    program.set("viewport", glm::vec2(view.size));
    program.set("colors", 0);
    program.set("depths", 1);
    gl_.DrawArrays(GL_TRIANGLES, 0, gl_.software ? 3 : static_cast<GLsizei>(6 * visible_));
  };
  const BlendScope blend(gl_);
  gl_.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  draw_all(blended_);
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_.DepthMask(GL_TRUE);
  draw_all(solid_);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  debug_check_gl(gl_, "splats");
}

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
