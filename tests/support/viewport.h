// The viewport that tests use.
#pragma once

#include "document/camera.h"

namespace viete::test {

inline const document::Viewport viewport{{1000, 800}, {320, 0}, {680, 774}};

}  // namespace viete::test
