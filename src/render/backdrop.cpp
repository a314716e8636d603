#include "render/backdrop.h"

namespace viete::render {

Backdrop::Backdrop(const Gl& gl) : gl_(gl), program_(gl, "backdrop"), vertex_array_(gl) {}

void Backdrop::draw(const Theme& theme, const View& view) const {
  program_.use();
  program_.set("top", theme.background_top);
  program_.set("bottom", theme.background_bottom);
  const float low =
      view.whole.y > 0 ? static_cast<float>(view.corner.y) / static_cast<float>(view.whole.y) : 0;
  program_.set("heights", glm::vec2(low, 1 / view.heights()));
  program_.set("tile_corner", glm::vec2(view.corner));
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.BindVertexArray(vertex_array_.id());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  debug_check_gl(gl_, "backdrop");
}

}  // namespace viete::render
