// Products of the small matrices and vectors of a map.
#pragma once

#include "mesh/vector.h"
#include "sym3/products.h"
#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::deform {

inline mesh::Vec3 times(const sym3::Sym3<double>& s, const mesh::Vec3& x) {
  return {s.xx * x[0] + s.xy * x[1] + s.xz * x[2], s.xy * x[0] + s.yy * x[1] + s.yz * x[2],
          s.xz * x[0] + s.yz * x[1] + s.zz * x[2]};
}

inline mesh::Vec3 times(const sym3::Mat3<double>& m, const mesh::Vec3& x) {
  return {m[0] * x[0] + m[1] * x[1] + m[2] * x[2], m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
          m[6] * x[0] + m[7] * x[1] + m[8] * x[2]};
}

inline sym3::Mat3<double> times(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b) {
  return sym3::product(a, b);
}

using sym3::full;

}  // namespace viete::deform
