// Checks arrays of points and indices, and packs them for the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "base/error.h"
#include "render/gl.h"
#include "render/view.h"

namespace viete::render {

/// Returns the first finite point, or (0, 0, 0): the origin for positions that are stored as floats.
Point origin_of(std::span<const Point> points);

/// Returns point - origin as float. If the point is not finite, returns 0.
glm::vec3 relative(const Point& point, const Point& origin);

/// Uploads each point as a vec4: x, y, z relative to the origin, and 1.
void upload_points(Buffer& buffer, std::span<const Point> points, const Point& origin);

/// If the numbers differ, throws base::Error with the place `what`.
void require_count(const char* what, std::size_t count, std::size_t expected);

/// If a buffer texture cannot store this number of texels, throws base::Error with the place `what`.
void require_texels(const Gl& gl, const char* what, std::size_t texels);

/// If a vertex index is vertex_count or more, throws base::Error with the place `what` and the element.
template <std::size_t n>
void require_indices(const char* what, std::span<const std::array<std::uint32_t, n>> elements,
                     std::size_t vertex_count) {
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const std::uint32_t vertex : elements[i]) {
      if (vertex < vertex_count) continue;
      throw base::Error(
          std::string(what) + ": element " + std::to_string(i),
          "refers to vertex " + std::to_string(vertex) + ", the mesh has " + std::to_string(vertex_count));
    }
}

/// Sets the camera matrices for points stored relative to `origin`.
void set_camera(const Program& program, const View& view, const Point& origin);

/// Turns on blending and the depth test, and turns off depth writes. The destructor restores the usual state.
class BlendScope {
public:
  explicit BlendScope(const Gl& gl);
  BlendScope(const BlendScope&) = delete;
  BlendScope& operator=(const BlendScope&) = delete;
  ~BlendScope();

private:
  const Gl& gl_;
};

/// If `hidden` is above 0, draws the parts behind other surfaces: calls set_opacity(hidden) and draw(). Then
/// draws the visible parts: calls set_opacity(visible) and draw().
template <class SetOpacity, class Draw>
void draw_hidden_then_visible(const Gl& gl, float hidden, float visible, SetOpacity set_opacity, Draw draw) {
  const BlendScope blend(gl);
  if (hidden > 0) {
    gl.DepthFunc(GL_GREATER);
    set_opacity(hidden);
    draw();
  }
  gl.DepthFunc(GL_LEQUAL);
  set_opacity(visible);
  draw();
}

}  // namespace viete::render
