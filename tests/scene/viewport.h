// The part of the window that the tests look into.
#pragma once

#include "scene/document/camera.h"

namespace viete::test {

inline const scene::Viewport viewport{{1000, 800}, {320, 0}, {680, 774}};

}  // namespace viete::test
