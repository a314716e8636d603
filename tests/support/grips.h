// Selected cage vertices of a new window, without a mirror.
#pragma once

#include "scene/hand/grip.h"

namespace viete::test {

inline scene::Grip plain_grip(const scene::Document& document) {
  return scene::grip_of(document, {}, nullptr, {});
}

inline glm::dvec3 selection_center(const scene::Document& document) {
  return plain_grip(document).anchor.center;
}

}  // namespace viete::test
