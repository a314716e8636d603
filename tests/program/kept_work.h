// Viewers with a state folder, a small model and recovery files.
#pragma once

#include "files/open.h"
#include "formats/write.h"
#include "program/desktop.h"
#include "program/driver.h"
#include "support/ball.h"
#include "support/folder.h"

namespace viete::test {

inline app::ViewerOptions remembering(const fs::path& state, glm::ivec2 size = {1280, 800}) {
  auto options = Driver::default_options(size);
  options.state = state;
  return options;
}

inline void drag_some_vertex(Driver& d, glm::vec2 by) {
  const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
  d.drag(at, at + by);
}

// Returns the view when it no longer changes. Panels are black, because their timings always differ.
inline render::Image rest_picture(Driver& d) {
  d.move({700, 760});
  d.workspace().panels.has_user = false;  // hides messages, which disappear after some time
  d.settle();
  d.workspace().panels.has_user = true;
  render::Image picture = d.picture();
  const auto& v = d.workspace().view.camera.viewport;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const glm::vec2 in_view = glm::vec2(x, y) - v.origin;
      const bool seen = in_view.x >= 0 && in_view.y >= 0 && in_view.x < v.size.x && in_view.y < v.size.y;
      if (!seen)
        std::fill_n(picture.rgba.begin() + 4 * (std::ptrdiff_t(y) * picture.width + x), 4, std::uint8_t{0});
    }
  return picture;
}

inline std::vector<fs::path> kept_files(const fs::path& state) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(state / "recovery", ignored)) files.push_back(entry.path());
  return files;
}

// Files of a small model and its cage, which load quickly.
struct SmallModel {
  fs::path model, cage;

  explicit SmallModel(const fs::path& folder) : model(folder / "small.ply"), cage(folder / "small_cage.obj") {
    formats::write(model, ball(1, 3));
    formats::write(cage, ball(1.4, 1));
  }
};

}  // namespace viete::test
