#include "render/shadow_layer.h"

#include <algorithm>
#include <cmath>

#include "base/worker_pool.h"
#include "render/upload.h"

namespace viete::render {

namespace {

constexpr std::size_t place_count = 24000;
constexpr int cells_per_size = 96, most_cells = 252;        // most_cells: a multiple of GroundShadow::square
constexpr int near_radius = 1, far_radius = 4, passes = 3;  // blur radii in cells, and the number of passes
constexpr int margin = passes * far_radius + 1;             // the largest distance of a blur, in cells
// Heights above and depth below the ground where darkness falls to 37 %, in units of the model's size.
constexpr float near_height = 0.03F, far_height = 0.32F, depth = 0.02F;
constexpr float near_darkness = 0.8F, far_darkness = 0.75F;

double area(const Point& a, const Point& b, const Point& c) {
  const glm::dvec3 u(b[0] - a[0], b[1] - a[1], b[2] - a[2]), v(c[0] - a[0], c[1] - a[1], c[2] - a[2]);
  const double twice = glm::length(glm::cross(u, v));
  return std::isfinite(twice) ? 0.5 * twice : 0;
}

// Returns the barycentric coordinates of point i of a low-discrepancy sequence in a triangle. Source: M.
// Roberts, 2018, "The unreasonable effectiveness of quasirandom sequences".
std::array<float, 3> shares(std::size_t i) {
  double a = std::fmod(0.7548776662466927 * static_cast<double>(i) + 0.5, 1.0);
  double b = std::fmod(0.5698402909980532 * static_cast<double>(i) + 0.5, 1.0);
  if (a + b > 1) {
    a = 1 - a;
    b = 1 - b;
  }
  return {static_cast<float>(1 - a - b), static_cast<float>(a), static_cast<float>(b)};
}

// A grid of values that can be blurred.
class Cells {
public:
  Cells(int width, int height)
      : width_(width), height_(height), values_(static_cast<std::size_t>(width) * height) {}

  float& at(int x, int y) { return values_[static_cast<std::size_t>(y) * width_ + x]; }
  std::span<const float> values() const { return values_; }

  void blur(int radius) {
    for (int pass = 0; pass < passes; ++pass) {
      for (int y = 0; y < height_; ++y) average(&at(0, y), width_, 1, radius);
      for (int x = 0; x < width_; ++x) average(&at(x, 0), height_, width_, radius);
    }
  }

private:
  // Replaces each value in a row or column by the mean within `radius`. Values outside the grid count as 0.
  void average(float* line, int count, int stride, int radius) {
    line_.assign(static_cast<std::size_t>(count + 2 * radius + 1), 0);
    for (int i = 0; i < count; ++i) line_[i + radius] = line[static_cast<std::ptrdiff_t>(i) * stride];
    const float share = 1.0F / static_cast<float>(2 * radius + 1);
    float sum = 0;
    for (int i = 0; i < 2 * radius; ++i) sum += line_[i];
    for (int i = 0; i < count; ++i) {
      sum += line_[i + 2 * radius];
      line[static_cast<std::ptrdiff_t>(i) * stride] = sum * share;
      sum -= line_[i];
    }
  }

  int width_, height_;
  std::vector<float> values_, line_;
};

// False if the point is not finite, or so far away that a float cannot tell neighbouring cells apart.
bool has_cell(const glm::vec3& point, float cell) {
  return glm::all(glm::lessThan(glm::abs(glm::vec2(point)), glm::vec2(0x1p22F * cell)));
}

struct Box {
  glm::vec2 low{1e30F}, high{-1e30F};
};

Box bounds(std::span<const glm::vec3> points, float cell) {
  Box box;
  for (const auto& p : points) {
    if (has_cell(p, cell)) {
      box.low = glm::min(box.low, glm::vec2(p));
      box.high = glm::max(box.high, glm::vec2(p));
    }
  }
  return box;
}

int whole_squares(float cells) {
  constexpr int side = GroundShadow::square;
  return (static_cast<int>(cells) + side - 1) / side * side;
}

// Finds the squares that have shadow inside or in an adjacent cell, because filtering spreads darkness.
void find_squares(GroundShadow& shadow) {
  constexpr int side = GroundShadow::square, least = 2;
  const auto is_dark = [&](int column, int row) {
    for (int y = std::max(0, row * side - 1); y < std::min(shadow.height, (row + 1) * side + 1); ++y) {
      const auto* line = &shadow.darkness[static_cast<std::size_t>(y) * shadow.width];
      const int begin = std::max(0, column * side - 1), end = std::min(shadow.width, (column + 1) * side + 1);
      if (std::any_of(line + begin, line + end, [](std::uint8_t d) { return d >= least; })) return true;
    }
    return false;
  };
  for (int row = 0; row < shadow.height / side; ++row)
    for (int column = 0; column < shadow.width / side; ++column) {
      if (is_dark(column, row))
        shadow.squares.push_back({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)});
    }
}

}  // namespace

std::vector<SpreadPoint> spread_points(std::span<const Triangle> triangles,
                                       std::span<const Point> positions) {
  std::vector<SpreadPoint> points;
  const auto area_of = [&](const Triangle& t) {
    return area(positions[t[0]], positions[t[1]], positions[t[2]]);
  };
  const double whole = base::sum_of_blocks(triangles.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t t = begin; t < end; ++t) sum += area_of(triangles[t]);
    return sum;
  });
  if (!(whole > 0) || !std::isfinite(whole)) return points;
  points.reserve(place_count);
  double passed = 0;
  for (const Triangle& t : triangles) {
    passed += area_of(t) / whole;
    while (points.size() < place_count && (static_cast<double>(points.size()) + 0.5) / place_count < passed)
      points.push_back({t, shares(points.size())});
  }
  return points;
}

// Aligns the cells to a fixed grid. Otherwise, the shadow of a moving model would shimmer.
GroundShadow ground_shadow(std::span<const glm::vec3> points, float size) {
  GroundShadow shadow;
  shadow.cell = size / cells_per_size;
  const Box box = bounds(points, shadow.cell);
  if (!(shadow.cell > 0) || !(box.low.x <= box.high.x)) return shadow;
  const glm::vec2 first = glm::floor(box.low / shadow.cell) - static_cast<float>(margin);
  const glm::vec2 count = glm::min(
      glm::floor(box.high / shadow.cell) + 1.0F + static_cast<float>(margin) - first, glm::vec2(most_cells));
  if (!(count.x > 0 && count.y > 0)) return shadow;
  shadow.low = first * shadow.cell;
  shadow.width = whole_squares(count.x);
  shadow.height = whole_squares(count.y);

  Cells near_by(shadow.width, shadow.height), far_off(shadow.width, shadow.height);
  for (const auto& p : points) {
    if (!has_cell(p, shadow.cell)) continue;
    const glm::vec2 at = glm::floor(glm::vec2(p) / shadow.cell) - first;
    const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
    if (x >= shadow.width - margin || y >= shadow.height - margin) continue;
    const float h = p.z / size, below = std::min(1.0F, std::exp(h / depth));
    const auto raise = [&](float& value, float by) { value = std::max(value, by); };
    raise(near_by.at(x, y), below * std::exp(-std::max(h, 0.0F) / near_height));
    raise(far_off.at(x, y), below * std::exp(-std::max(h, 0.0F) / far_height));
  }
  near_by.blur(near_radius);
  far_off.blur(far_radius);
  shadow.darkness.resize(near_by.values().size());
  for (std::size_t i = 0; i < shadow.darkness.size(); ++i) {
    const float light = (1 - near_darkness * near_by.values()[i]) * (1 - far_darkness * far_off.values()[i]);
    shadow.darkness[i] = static_cast<std::uint8_t>(std::lround(255 * (1 - light)));
  }
  find_squares(shadow);
  return shadow;
}

float from_above(const View& view, const ShadowStyle& style) {
  const glm::dvec4 center = view.view * glm::dvec4(style.center[0], style.center[1], style.center[2], 1);
  const glm::dvec3 up((style.down ? -1.0 : 1.0) * glm::normalize(glm::dvec3(view.view[style.up])));
  const bool perspective = view.projection[3][3] == 0;
  const glm::dvec3 to_eye = perspective ? -glm::normalize(glm::dvec3(center)) : glm::dvec3(0, 0, 1);
  return static_cast<float>(glm::smoothstep(0.0, 0.12, glm::dot(to_eye, up)));
}

ShadowLayer::ShadowLayer(const Gl& gl)
    : gl_(gl), program_(gl, "shadow"), vertex_array_(gl), darkness_(gl), squares_(gl, GL_RG32UI) {}

void ShadowLayer::set_triangles(std::span<const Triangle> triangles, std::span<const Point> positions) {
  require_indices("shadow", triangles, positions.size());
  spread_ = spread_points(triangles, positions);
  vertex_count_ = positions.size();
  set_positions(positions);
}

void ShadowLayer::set_points(std::span<const std::uint32_t> vertices, std::span<const Point> positions) {
  spread_.clear();
  const std::size_t count = std::min(vertices.size(), place_count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t v = vertices[i * vertices.size() / count];
    spread_.push_back({{v, v, v}, {1, 0, 0}});
  }
  vertex_count_ = positions.size();
  set_positions(positions);
}

template <class At>
void ShadowLayer::move(const At& at, const Point& origin) {
  points_.clear();
  for (const auto& place : spread_) {
    glm::vec3 p(0);
    for (std::size_t k = 0; k < 3; ++k) p += place.shares[k] * at(place.corners[k]);
    if (glm::all(glm::lessThan(glm::abs(p), glm::vec3(1e30F)))) points_.push_back(p);
  }
  origin_ = origin;
  moved_ = true;
}

void ShadowLayer::set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin) {
  require_count("shadow vertices", vertices.size(), vertex_count_);
  const auto at = [&](std::uint32_t v) {
    const float* p = vertices[v].position;
    return glm::vec3(p[0], p[1], p[2]);
  };
  move(at, origin);
}

void ShadowLayer::set_positions(std::span<const Point> positions) {
  require_count("shadow positions", positions.size(), vertex_count_);
  const Point origin = origin_of(positions);
  move([&](std::uint32_t v) { return relative(positions[v], origin); }, origin);
}

// Computes in units of the model's size, so that very large and very small models are in the range of float.
void ShadowLayer::cast(const ShadowStyle& style) {
  const int across = (style.up + 1) % 3, along = (style.up + 2) % 3;
  const auto per_size = static_cast<float>(1 / style.size);
  glm::vec3 shift;
  for (int i = 0; i < 3; ++i) shift[i] = static_cast<float>((origin_[i] - style.center[i]) / style.size);
  over_ground_.clear();
  for (const auto& p : points_) {
    const glm::vec3 q = per_size * p + shift;
    over_ground_.emplace_back(q[across], q[along], style.down ? -q[style.up] : q[style.up]);
  }
  shadow_ = ground_shadow(over_ground_, 1);
  cast_on_ = style;
  moved_ = false;
  if (shadow_.squares.empty()) return;
  squares_.buffer.upload(shadow_.squares.data(), shadow_.squares.size() * sizeof(shadow_.squares[0]),
                         GL_STREAM_DRAW);
  set_texture(gl_, 0, darkness_, shadow_.width, shadow_.height, {GL_R8, GL_RED, GL_UNSIGNED_BYTE},
              shadow_.darkness.data());
}

void ShadowLayer::draw(const View& view, const Theme& theme, const ShadowStyle& style) {
  if (moved_ || !(style == cast_on_)) cast(style);
  if (shadow_.squares.empty()) return;
  const int across = (style.up + 1) % 3, along = (style.up + 2) % 3;
  glm::mat4 axes(0);
  axes[0][across] = axes[1][along] = axes[2][style.up] = static_cast<float>(style.size);
  axes[3][3] = 1;
  const float seen = from_above(view, style);
  if (seen <= 0) return;
  const glm::vec2 extent = shadow_.cell * glm::vec2(shadow_.width, shadow_.height);
  program_.use();
  program_.set("darkness", 0);
  program_.set("squares", 1);
  program_.set("eye_from_ground", eye_matrix(view, style.center) * axes);
  program_.set("clip_from_eye", glm::mat4(view.projection));
  program_.set("place", glm::vec4(shadow_.low, extent));
  program_.set("share", static_cast<float>(GroundShadow::square) / glm::vec2(shadow_.width, shadow_.height));
  program_.set("color", glm::vec4(glm::vec3(theme.shadow), seen * theme.shadow.a));
  bind_texture(gl_, 0, darkness_);
  squares_.bind(1);
  const BlendScope blend(gl_);
  gl_.BindVertexArray(vertex_array_.id());
  gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * shadow_.squares.size()));
  debug_check_gl(gl_, "shadow");
}

}  // namespace viete::render
