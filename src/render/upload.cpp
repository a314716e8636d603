#include "render/upload.h"

#include <cmath>

namespace viete::render {

namespace {

bool finite(const Point& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

}  // namespace

Point origin_of(std::span<const Point> points) {
  for (const Point& p : points) {
    if (finite(p)) return p;
  }
  return {0, 0, 0};
}

glm::vec3 relative(const Point& point, const Point& origin) {
  if (!finite(point)) return glm::vec3(0);
  return {static_cast<float>(point[0] - origin[0]), static_cast<float>(point[1] - origin[1]),
          static_cast<float>(point[2] - origin[2])};
}

void upload_points(Buffer& buffer, std::span<const Point> points, const Point& origin) {
  if (points.empty()) return;
  auto* packed = static_cast<glm::vec4*>(buffer.map(points.size() * sizeof(glm::vec4)));
  for (std::size_t i = 0; i < points.size(); ++i) packed[i] = glm::vec4(relative(points[i], origin), 1);
  buffer.unmap();
}

void require_count(const char* what, std::size_t count, std::size_t expected) {
  if (count == expected) return;
  throw base::Error(what, "there are " + std::to_string(count) + ", expected " + std::to_string(expected));
}

void require_texels(const Gl& gl, const char* what, std::size_t texels) {
  if (texels <= static_cast<std::size_t>(gl.max_texels)) return;
  throw base::Error(what,
                    std::to_string(texels) + " texels are needed, the graphics driver's limit is " +
                        std::to_string(gl.max_texels),
                    "use a smaller mesh or another graphics driver");
}

void set_camera(const Program& program, const View& view, const Point& origin) {
  program.set("eye_from_model", eye_matrix(view, origin));
  program.set("clip_from_eye", glm::mat4(view.projection));
}

BlendScope::BlendScope(const Gl& gl) : gl_(gl) {
  gl.Enable(GL_BLEND);
  gl.BlendEquation(GL_FUNC_ADD);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
  gl.DepthMask(GL_FALSE);
}

BlendScope::~BlendScope() {
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.DepthMask(GL_TRUE);
}

}  // namespace viete::render
