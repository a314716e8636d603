#include "sym3/rotation.h"

#include <cmath>

namespace viete::sym3 {

namespace {

// cos(sqrt h) and sin(sqrt h) / (2 sqrt h) on 0 <= h <= 2.63: minimax, first coefficient kept exact, the
// others rounded one after the other with a refit of the rest. Error 0.07 u and 0.002 u in double, 1.3 u and
// 0.1 u in float (u = unit roundoff).
constexpr double half_angle_limit = 2.63;

template <class T>
struct Tables;

template <>
struct Tables<double> {
  static constexpr double cosine[] = {1,
                                      -0x1.ffffffffffffbp-2,
                                      0x1.555555555535fp-5,
                                      -0x1.6c16c16c060c9p-10,
                                      0x1.a01a0197888c5p-16,
                                      -0x1.27e4f90a36103p-22,
                                      0x1.1eecc1ff6300ap-29,
                                      -0x1.9348c9b978ad7p-37,
                                      0x1.9e4b50f4cbd6ep-45};
  static constexpr double sine[] = {0.5,
                                    -0x1.5555555555555p-4,
                                    0x1.11111111110bep-8,
                                    -0x1.a01a01a013efcp-14,
                                    0x1.71de3a52246f8p-20,
                                    -0x1.ae6454932cf3cp-27,
                                    0x1.6123bb08176d3p-34,
                                    -0x1.ae3e84226c1b0p-42,
                                    0x1.87a537e1c6d70p-50};
};

template <>
struct Tables<float> {
  static constexpr float cosine[] = {1, -0x1.ffffc6p-2f, 0x1.554e94p-5f, -0x1.6b1c82p-10f, 0x1.836f3ap-16f};
  static constexpr float sine[] = {0.5, -0x1.55554ap-4f, 0x1.110e82p-8f, -0x1.9f5faap-14f, 0x1.5cc5e0p-20f};
};

template <class T, std::size_t N>
T horner(const T (&c)[N], T x) {
  T sum = c[N - 1];
  for (std::size_t k = N - 1; k-- > 0;) sum = sum * x + c[k];
  return sum;
}

/// 0, or NaN if an entry is NaN or infinite. (Three-argument std::hypot loses a NaN.)
template <class Entries>
auto zero_if_finite(const Entries& entries) {
  typename Entries::value_type sum = 0;
  for (const auto x : entries) sum += x * 0;
  return sum;
}

/// Scalar part first.
template <class T>
struct Quaternion {
  T w, x, y, z;
};

template <class T>
Quaternion<T> exp_quaternion(const Vec3<T>& w) {
  const T h = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) / 4;
  T c, s;
  if (h <= T(half_angle_limit)) {
    c = horner(Tables<T>::cosine, h);
    s = horner(Tables<T>::sine, h);
  } else {
    const T angle = std::hypot(w[0], w[1], w[2]) + zero_if_finite(w);
    c = std::cos(angle / 2);
    s = std::sin(angle / 2) / angle;
  }
  return {c, s * w[0], s * w[1], s * w[2]};
}

template <class T>
Mat3<T> to_matrix(const Quaternion<T>& q) {
  const T xx = 2 * q.x * q.x, yy = 2 * q.y * q.y, zz = 2 * q.z * q.z;
  const T xy = 2 * q.x * q.y, xz = 2 * q.x * q.z, yz = 2 * q.y * q.z;
  const T wx = 2 * q.w * q.x, wy = 2 * q.w * q.y, wz = 2 * q.w * q.z;
  return {1 - (yy + zz), xy - wz, xz + wy, xy + wz, 1 - (xx + zz), yz - wx, xz - wy, yz + wx, 1 - (xx + yy)};
}

/// Four times the products of w, x, y, z with the one of them that is largest (Shepperd 1978), so that
/// nothing cancels: a quaternion of length between 2 and 4.
template <class T>
Quaternion<T> to_quaternion(const Mat3<T>& r) {
  const T xx = r[0], yy = r[4], zz = r[8], trace = xx + yy + zz;
  const T dx = r[7] - r[5], dy = r[2] - r[6], dz = r[3] - r[1];
  const T sx = r[7] + r[5], sy = r[2] + r[6], sz = r[3] + r[1];
  if (trace >= xx && trace >= yy && trace >= zz) return {1 + trace, dx, dy, dz};
  if (xx >= yy && xx >= zz) return {dx, 1 + xx - yy - zz, sz, sy};
  if (yy >= zz) return {dy, sz, 1 + yy - xx - zz, sx};
  return {dz, sy, sx, 1 + zz - xx - yy};
}

/// Of q and -q the one with angle <= pi; at pi the one whose axis starts with a positive number.
template <class T>
bool is_wrong_half(const Quaternion<T>& q) {
  if (q.w != 0) return q.w < 0;
  if (q.x != 0) return q.x < 0;
  if (q.y != 0) return q.y < 0;
  return q.z < 0;
}

}  // namespace

template <class T>
Mat3<T> exp_rotation(const Vec3<T>& w) {
  return to_matrix(exp_quaternion(w));
}

template <class T>
Vec3<T> log_rotation(const Mat3<T>& r) {
  Quaternion<T> q = to_quaternion(r);
  if (is_wrong_half(q)) q = {-q.w, -q.x, -q.y, -q.z};
  const T sine = std::hypot(q.x, q.y, q.z) + zero_if_finite(r);
  const T factor = sine != 0 ? 2 * std::atan2(sine, q.w) / sine : T(0);
  return {q.x * factor, q.y * factor, q.z * factor};
}

template Mat3<float> exp_rotation(const Vec3<float>&);
template Mat3<double> exp_rotation(const Vec3<double>&);
template Vec3<float> log_rotation(const Mat3<float>&);
template Vec3<double> log_rotation(const Mat3<double>&);

}  // namespace viete::sym3
