// Places of files as vectors of GLM, and back.
#pragma once

#include <glm/glm.hpp>

#include "mesh/vector.h"

namespace viete::scene {

inline glm::dvec3 vector_of(const mesh::Vec3& p) {
  return {p[0], p[1], p[2]};
}
inline mesh::Vec3 point_of(const glm::dvec3& p) {
  return {p.x, p.y, p.z};
}

}  // namespace viete::scene
