// Checks arrays of points and indices and packs them for the GPU.
#pragma once

#include <cstdint>
#include <span>

#include "render/gl.h"
#include "render/view.h"

namespace viete::render {

/// The first finite point, or 0 if there is none. Vertices are stored as float relative to it.
Point origin_of(std::span<const Point> points);

/// point - origin as float; non-finite points give 0.
glm::vec3 relative(const Point& point, const Point& origin);

/// Uploads points as vec4 (position relative to origin, 1).
void upload_points(Buffer& buffer, std::span<const Point> points, const Point& origin);

/// Throws base::Error naming `what` if the sizes differ.
void require_count(const char* what, std::size_t count, std::size_t expected);

/// Throws base::Error naming `what` if a buffer texture cannot store that many texels.
void require_texels(const Gl& gl, const char* what, std::size_t texels);

/// Throws base::Error naming the first element of `what` with a vertex index >= vertex_count.
template <std::size_t n>
void require_indices(const char* what, std::span<const std::array<std::uint32_t, n>> elements,
                     std::size_t vertex_count);

extern template void require_indices<2>(const char*, std::span<const std::array<std::uint32_t, 2>>,
                                        std::size_t);
extern template void require_indices<3>(const char*, std::span<const std::array<std::uint32_t, 3>>,
                                        std::size_t);

/// GL state of translucent layers for the current scope: blending on, depth tested but not written.
class BlendScope {
public:
  explicit BlendScope(const Gl& gl);
  BlendScope(const BlendScope&) = delete;
  BlendScope& operator=(const BlendScope&) = delete;
  ~BlendScope();

private:
  const Gl& gl_;
};

/// Draws the parts behind something first, then the rest. Calls set_opacity(factor) before each.
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
