// The program with a small scene, which is drawn quickly.
#pragma once

#include "formats/write.h"
#include "program/driver.h"
#include "support/ball.h"
#include "support/folder.h"

namespace viete::test {

inline app::ViewerOptions small_options(glm::ivec2 size = {700, 420}) {
  return Driver::default_options(size);
}

// A ball with 642 vertices in a cage with 42 vertices.
struct SmallScene {
  explicit SmallScene(const app::ViewerOptions& options = small_options(),
                      std::optional<WithPixels> pixels = {})
      : d(options, pixels) {
    formats::write(folder / "ball.obj", ball(1, 3));
    formats::write(folder / "cage.obj", ball(1.2, 1));
    REQUIRE(d.open({folder / "ball.obj", folder / "cage.obj"}));
    d.settle();
  }

  TemporaryFolder folder;
  Driver d;
};

}  // namespace viete::test
