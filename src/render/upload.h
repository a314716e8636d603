// Checks arrays of points and indices and packs them for the GPU.
#pragma once

#include <cstdint>
#include <span>

#include "render/gl.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

/// The first finite point, or (0, 0, 0) if there is none. Vertices are stored as float relative to it.
Point origin_of(std::span<const Point> points);

/// point - origin as float, or 0 for a non-finite point.
glm::vec3 relative(const Point& point, const Point& origin);

/// Uploads each point as a vec4: x, y, z relative to the origin, and 1.
void upload_points(Buffer& buffer, std::span<const Point> points, const Point& origin);

/// Throws base::Error with the place `what` if the numbers differ.
void require_count(const char* what, std::size_t count, std::size_t expected);

/// Throws base::Error with the place `what` if a buffer texture cannot store this number of texels.
void require_texels(const Gl& gl, const char* what, std::size_t texels);

/// Throws base::Error with the place `what` and the element if a vertex index is not below vertex_count.
template <std::size_t n>
void require_indices(const char* what, std::span<const std::array<std::uint32_t, n>> elements,
                     std::size_t vertex_count);

extern template void require_indices<2>(const char*, std::span<const std::array<std::uint32_t, 2>>,
                                        std::size_t);
extern template void require_indices<3>(const char*, std::span<const std::array<std::uint32_t, 3>>,
                                        std::size_t);

/// Sets the camera matrices for points stored relative to `origin`.
void set_camera(const Program& program, const View& view, const Point& origin);

/// In its scope the GL state is that of translucent layers: blending is on, depth is tested but not written.
class BlendScope {
public:
  explicit BlendScope(const Gl& gl);
  BlendScope(const BlendScope&) = delete;
  BlendScope& operator=(const BlendScope&) = delete;
  ~BlendScope();

private:
  const Gl& gl_;
};

/// Calls set_opacity(hidden) and draw() for the hidden parts, then set_opacity(visible) and draw() for the
/// visible parts.
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
