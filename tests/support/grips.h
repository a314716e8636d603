// The grip of the selected cage vertices, without mirror and without soft selection.
#pragma once

#include "interact/grip.h"

namespace viete::test {

inline interact::Grip plain_grip(const document::Document& document) {
  return interact::grip_of(document, {}, nullptr, {});
}

inline glm::dvec3 selection_center(const document::Document& document) {
  return plain_grip(document).anchor.center;
}

}  // namespace viete::test
