#include "render/backdrop.h"

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

}  // namespace viete::render
