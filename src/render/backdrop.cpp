#include "render/backdrop.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "render/upload.h"

namespace viete::render {

Backdrop::Backdrop(const Gl& gl) : gl_(gl), program_(gl, "backdrop"), vertex_array_(gl) {}

void Backdrop::draw(const Theme& theme) const {
  program_.use();
  program_.set("top", theme.background_top);
  program_.set("bottom", theme.background_bottom);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.BindVertexArray(vertex_array_.id());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  debug_check_gl(gl_, "backdrop");
}

namespace {

float phase(double value, double period) {
  return static_cast<float>(value - period * std::floor(value / period));
}

}  // namespace

Grid::Grid(const Gl& gl) : gl_(gl), program_(gl, "grid"), vertex_array_(gl) {}

void Grid::draw(const View& view, const Theme& theme, const GridStyle& style) const {
  const int across = (style.up + 1) % 3, along = (style.up + 2) % 3;
  glm::mat3 axes(0);
  axes[0][across] = axes[1][along] = 1;
  axes[2][style.up] = style.down ? -1.0F : 1.0F;
  const double period = 10 * style.cell;

  program_.use();
  program_.set("eye_from_ground", eye_matrix(view, style.center) * glm::mat4(axes));
  program_.set("clip_from_eye", glm::mat4(view.projection));
  program_.set("perspective", view.projection[3][3] == 0 ? 1.0F : 0.0F);
  program_.set("phase", glm::vec2(phase(style.center[across], period), phase(style.center[along], period)));
  program_.set("cell", static_cast<float>(style.cell));
  program_.set("radius", static_cast<float>(style.radius));
  program_.set("line_width", view.scale);
  program_.set("color", glm::vec4(theme.grid, 1));
  const BlendScope blend(gl_);
  gl_.BindVertexArray(vertex_array_.id());
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  debug_check_gl(gl_, "grid");
}

}  // namespace viete::render
