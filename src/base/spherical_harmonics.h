// Real spherical harmonics, with the order and signs of captures (Gaussian splats).
#pragma once

#include <array>

namespace viete::base {

/// Returns the values of the harmonics of degrees 1 to `degree` in the direction of the unit vector (x, y,
/// z): first 3 of degree 1, then 5, then 7. Other entries are 0. `degree` is 0 to 3. The harmonic of degree 0
/// is constant. Source: B. Kerbl et al., 3D Gaussian Splatting for Real-Time Radiance Field Rendering, 2023.
template <class T>
std::array<T, 15> harmonics_at(T x, T y, T z, int degree) {
  if (degree < 1) return {};
  std::array<T, 15> at{T(-0.4886025119029199) * y, T(0.4886025119029199) * z, T(-0.4886025119029199) * x};
  if (degree < 2) return at;
  const T xx = x * x, yy = y * y, zz = z * z;
  at[3] = T(1.0925484305920792) * x * y;
  at[4] = T(-1.0925484305920792) * y * z;
  at[5] = T(0.31539156525252005) * (2 * zz - xx - yy);
  at[6] = T(-1.0925484305920792) * x * z;
  at[7] = T(0.5462742152960396) * (xx - yy);
  if (degree < 3) return at;
  at[8] = T(-0.5900435899266435) * y * (3 * xx - yy);
  at[9] = T(2.890611442640554) * x * y * z;
  at[10] = T(-0.4570457994644658) * y * (4 * zz - xx - yy);
  at[11] = T(0.3731763325901154) * z * (2 * zz - 3 * xx - 3 * yy);
  at[12] = T(-0.4570457994644658) * x * (4 * zz - xx - yy);
  at[13] = T(1.445305721320277) * z * (xx - yy);
  at[14] = T(-0.5900435899266435) * x * (xx - 3 * yy);
  return at;
}

}  // namespace viete::base
