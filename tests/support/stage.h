// An offscreen context with a framebuffer, and simple surfaces.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <vector>

#include "base/error.h"
#include "platform/offscreen_context.h"
#include "render/framebuffer.h"
#include "render/view.h"
#include "support/skip.h"

namespace viete::test {

using render::Point;

/// True if this kind of context is available. Otherwise, skips the test case.
inline bool available(platform::OffscreenContext::Kind kind) {
  try {
    platform::OffscreenContext::create(kind);
    return true;
  } catch (const base::Error& error) {
    skip(error.what());
    return false;
  }
}

inline render::Gl load(const platform::OffscreenContext& context) {
  return render::load_gl([&](const char* name) { return context.get_proc_address(name); });
}

struct Stage {
  explicit Stage(platform::OffscreenContext::Kind kind = platform::OffscreenContext::Kind::any)
      : context(platform::OffscreenContext::create(kind)), gl(load(*context)), framebuffer(gl) {
    view.size = {320, 200};
    // Looks along -z from (0, 0, 10). The projection is parallel: a unit of length has 10 pixels.
    view.view = glm::lookAt(glm::dvec3(0, 0, 10), glm::dvec3(0), glm::dvec3(0, 1, 0));
    view.projection = glm::ortho(-16.0, 16.0, -10.0, 10.0, 0.1, 100.0);
  }

  render::Image picture(const std::function<void()>& draw, int samples = 0) {
    framebuffer.begin(view.size, samples);
    draw();
    framebuffer.resolve();
    render::check_gl(gl, "test picture");
    return framebuffer.read();
  }

  /// Returns the pixel of a point. The pixel (0, 0) is at the top left.
  glm::ivec2 pixel_of(const Point& point) const {
    const glm::dvec4 clip = view.projection * view.view * glm::dvec4(point[0], point[1], point[2], 1);
    const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
    return {static_cast<int>((0.5 + 0.5 * ndc.x) * view.size.x),
            static_cast<int>((0.5 - 0.5 * ndc.y) * view.size.y)};
  }

  std::unique_ptr<platform::OffscreenContext> context;
  render::Gl gl;
  render::Framebuffer framebuffer;
  render::View view;
};

struct Ball {
  std::vector<Point> positions;
  std::vector<base::PackedNormal> normals;
  std::vector<render::Triangle> triangles;
};

/// Returns a closed ball around `center`, counter-clockwise as seen from outside.
inline Ball ball(double radius, const Point& center = {0, 0, 0}, std::uint32_t rings = 48) {
  Ball result;
  const std::uint32_t columns = 2 * rings;
  for (std::uint32_t i = 0; i <= rings; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double polar = M_PI * i / rings, turn = 2 * M_PI * j / columns;
      const Point n{std::sin(polar) * std::sin(turn), std::cos(polar), std::sin(polar) * std::cos(turn)};
      result.normals.push_back(base::pack_normal(n));
      result.positions.push_back(
          {center[0] + radius * n[0], center[1] + radius * n[1], center[2] + radius * n[2]});
    }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const std::uint32_t a = i * columns + j, b = i * columns + (j + 1) % columns;
      result.triangles.push_back({a, a + columns, b});
      result.triangles.push_back({b, a + columns, b + columns});
    }
  return result;
}

/// Returns the sum of the three colour channels, from 0 to 765.
inline int brightness(const render::Rgba8& c) {
  return c[0] + c[1] + c[2];
}

/// Returns the area of a white shape on black, in pixels. Grey pixels at the edge count in part.
inline double lit_area(const render::Image& image) {
  double area = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) area += image.rgba[i] / 255.0;
  return area;
}

inline std::size_t count_not_black(const render::Image& image) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    count += image.rgba[i] + image.rgba[i + 1] + image.rgba[i + 2] > 0 ? 1 : 0;
  return count;
}

}  // namespace viete::test
