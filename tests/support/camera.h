// A camera beside a panel.
#pragma once

#include "document/camera.h"

namespace viete::test {

inline document::Camera camera(const document::CameraPose& pose = {}) {
  document::Camera camera;
  camera.viewport = {{1000, 800}, {320, 0}, {680, 774}};
  camera.set_pose(pose);
  return camera;
}

}  // namespace viete::test
