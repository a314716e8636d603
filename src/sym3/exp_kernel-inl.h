// The text of the fast exponential, compiled once per instruction set: see exp_fast_*.cpp. Internal.
//
// Algorithm: S = (m + e) I + A with A traceless; for a polynomial f(x) = sum a_k x^k,
//   f(A) = z_0 I + z_1 A + z_2 adj A,   z_k = a_k + p z_{k+2} + q z_{k+3},
// because A^3 = p A + q I with p = |A|^2 / 2 and q = det A. No eigenvalues, no division, no case distinction:
// equal eigenvalues are as exact as any others. f is the minimax polynomial of exp for every p up to p_limit;
// larger p go there by A / 2^j, and back by squaring the matrix j times.
//
// Everything lives in VIETE_KERNEL_NAMESPACE and calls no inline function from elsewhere, nor one of the
// standard library: such a function, compiled here for newer hardware, could be the copy that the linker
// keeps for all.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sym3/exp_kernels.h"

namespace viete::sym3::VIETE_KERNEL_NAMESPACE {

namespace {

/// Tables of one precision. `taylor` is the minimax polynomial of e^x divided by its last coefficient,
/// `lead`; it is weighted by the largest eigenvalue that a traceless matrix with eigenvalue x must have.
/// `exp_table` is e^r on |r| <= 0.3467.
template <class T>
struct Tables;

template <>
struct Tables<double> {
  using Bits = std::uint64_t;
  static constexpr double p_limit = 8, trace_limit = 1500, exponent_limit = 2800;
  static constexpr int max_squarings = 7;
  static constexpr int mantissa_bits = 52;
  static constexpr double round_magic = 0x1.8p52, log2_e = 0x1.71547652b82fep0;
  static constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;  // n ln2_high is exact
  static constexpr double lead = 0x1.88b702c1a20bcp-66;
  static constexpr double taylor[] = {0x1.4dc23888e53afp+65, 0x1.4dc23888e53afp+65,
                                      0x1.4dc23888e53a5p+64, 0x1.bd02f60bdc4cfp+62,
                                      0x1.bd02f60bdc70ep+60, 0x1.64025e6fe3915p+58,
                                      0x1.daadd33fd328fp+55, 0x1.0f3ec1db57c6fp+53,
                                      0x1.0f3ec1dc10dabp+50, 0x1.e236adf6e38edp+46,
                                      0x1.81c557cabf935p+43, 0x1.188f85ebf4ad5p+40,
                                      0x1.7614b9b15ec06p+36, 0x1.cc6835f638cfep+32,
                                      0x1.07164583a6869p+29, 0x1.18a1971462f6dp+25,
                                      0x1.18b85ef5fc3a7p+21, 0x1.081764ee83932p+17,
                                      0x1.d1f73b1653797p+12, 0x1.8b40b5079cde0p+8,
                                      0x1.63637a85474b7p+4,  0x1p+0};
  static constexpr double exp_table[] = {0x1p+0,
                                         0x1p+0,
                                         0x1.000000000000ap-1,
                                         0x1.5555555555504p-3,
                                         0x1.55555555506b7p-5,
                                         0x1.1111111125707p-7,
                                         0x1.6c16c1847938cp-10,
                                         0x1.a01a0135e60a9p-13,
                                         0x1.a01999564844cp-16,
                                         0x1.71df0cf7761fbp-19,
                                         0x1.28ae0727ec680p-22,
                                         0x1.ada449250c4e5p-26};
};

template <>
struct Tables<float> {
  using Bits = std::uint32_t;
  static constexpr float p_limit = 16, trace_limit = 150, exponent_limit = 340;
  static constexpr int max_squarings = 4;
  static constexpr int mantissa_bits = 23;
  static constexpr float round_magic = 0x1.8p23f, log2_e = 0x1.715476p0f;
  static constexpr float ln2_high = 0x1.62e4p-1f, ln2_low = 0x1.7f7d1cp-20f;  // n ln2_high is exact
  static constexpr float lead = 0x1.f7b082p-41f;
  static constexpr float taylor[] = {0x1.04394cp+40f, 0x1.04394cp+40f, 0x1.04394ep+39f, 0x1.5af70cp+37f,
                                     0x1.5af6dcp+35f, 0x1.1592c2p+33f, 0x1.721c58p+30f, 0x1.a6f0eep+27f,
                                     0x1.a6b9fcp+24f, 0x1.7831a8p+21f, 0x1.2ec56ep+18f, 0x1.b3f96ep+14f,
                                     0x1.126d7ap+11f, 0x1.674db4p+7f,  0x1.15e848p+4f,  0x1p+0f};
  static constexpr float exp_table[] = {0x1p+0f,        0x1p+0f,       0x1.fffffcp-2f, 0x1.555492p-3f,
                                        0x1.5558b2p-5f, 0x1.12398p-7f, 0x1.6a4994p-10f};
};

/// a b + c.
inline double mul_add(double a, double b, double c) {
#if VIETE_KERNEL_FUSED
  return __builtin_fma(a, b, c);
#else
  return a * b + c;
#endif
}

inline float mul_add(float a, float b, float c) {
#if VIETE_KERNEL_FUSED
  return __builtin_fmaf(a, b, c);
#else
  return a * b + c;
#endif
}

/// The six numbers of a symmetric matrix; not Sym3, whose members are inline functions.
template <class T>
struct Six {
  T xx, xy, xz, yy, yz, zz;
};

/// S = (mean + rest) I + a, with a traceless; rest is what rounding the mean left over.
template <class T>
struct Split {
  T trace, mean, rest;
  Six<T> a;
};

template <class T>
inline Split<T> split(const T* s) {
  constexpr T third = T(1) / T(3);
  const T trace = s[0] + s[3] + s[5];
  const T mean = trace * third;
  const T dx = s[0] - mean, dy = s[3] - mean, dz = s[5] - mean;
  const T rest = (dx + dy + dz) * third;
  return {trace, mean, rest, {dx - rest, s[1], s[2], dy - rest, s[4], dz - rest}};
}

/// a b - c d.
template <class T>
inline T difference_of_products(T a, T b, T c, T d) {
  return mul_add(a, b, -(c * d));
}

template <class T>
inline Six<T> adjugate(const Six<T>& a) {
  return {difference_of_products(a.yy, a.zz, a.yz, a.yz), difference_of_products(a.xz, a.yz, a.xy, a.zz),
          difference_of_products(a.xy, a.yz, a.xz, a.yy), difference_of_products(a.xx, a.zz, a.xz, a.xz),
          difference_of_products(a.xy, a.xz, a.xx, a.yz), difference_of_products(a.xx, a.yy, a.xy, a.xy)};
}

/// A traceless matrix with its adjugate and the two invariants: A^3 = p A + q I.
template <class T>
struct Invariants {
  Six<T> a, c;
  T p, q;
};

template <class T>
inline Invariants<T> invariants(const Six<T>& a) {
  const Six<T> c = adjugate(a);
  const T p = -(c.xx + c.yy + c.zz);
  const T q = mul_add(a.xx, c.xx, mul_add(a.xy, c.xy, a.xz * c.xz));
  return {a, c, p, q};
}

/// exp(A) = lead (z0 I + z1 A + z2 adj A).
template <class T>
struct Coefficients {
  T z0, z1, z2;
};

template <class T>
inline Coefficients<T> recurrence(T p, T q) {
  constexpr auto& a = Tables<T>::taylor;
  constexpr int degree = sizeof(a) / sizeof(T) - 1;
  T z2 = 1, z1 = a[degree - 1], z0 = p + a[degree - 2];
#pragma GCC unroll 32
  for (int k = degree - 3; k >= 0; --k) {
    const T next = mul_add(p, z1, mul_add(q, z2, a[k]));
    z2 = z1, z1 = z0, z0 = next;
  }
  return {z0, z1, z2};
}

template <class T>
inline Six<T> combine(const Coefficients<T>& z, const Six<T>& a, const Six<T>& c) {
  return {mul_add(z.z1, a.xx, mul_add(z.z2, c.xx, z.z0)),
          mul_add(z.z1, a.xy, z.z2 * c.xy),
          mul_add(z.z1, a.xz, z.z2 * c.xz),
          mul_add(z.z1, a.yy, mul_add(z.z2, c.yy, z.z0)),
          mul_add(z.z1, a.yz, z.z2 * c.yz),
          mul_add(z.z1, a.zz, mul_add(z.z2, c.zz, z.z0))};
}

/// x = n ln 2 + r, |r| <= 0.3467; n as the low bits of `shifted`.
template <class T>
struct Reduced {
  T r, n;
  typename Tables<T>::Bits n_bits;
};

template <class T>
inline Reduced<T> reduce(T x) {
  using C = Tables<T>;
  const T shifted = mul_add(x, C::log2_e, C::round_magic);
  const T n = shifted - C::round_magic;
  const T r = mul_add(-n, C::ln2_low, mul_add(-n, C::ln2_high, x));
  return {r, n, __builtin_bit_cast(typename C::Bits, shifted)};
}

/// scale e^r.
template <class T>
inline T scaled_exp(T r, T scale) {
  constexpr auto& c = Tables<T>::exp_table;
  constexpr int degree = sizeof(c) / sizeof(T) - 1;
  T sum = c[degree] * scale;  // products of constants: done by the compiler
#pragma GCC unroll 16
  for (int k = degree - 1; k >= 0; --k) sum = mul_add(sum, r, c[k] * scale);
  return sum;
}

/// x 2^n, for results in the normal range: n is added to the exponent field.
template <class T>
inline T add_to_exponent(T x, typename Tables<T>::Bits n) {
  using C = Tables<T>;
  return __builtin_bit_cast(T, __builtin_bit_cast(typename C::Bits, x) + (n << C::mantissa_bits));
}

template <class T>
inline void store(const Six<T>& m, T* out) {
  out[0] = m.xx, out[1] = m.xy, out[2] = m.xz, out[3] = m.yy, out[4] = m.yz, out[5] = m.zz;
}

template <class T>
inline Six<T> times(const Six<T>& m, T s) {
  return {m.xx * s, m.xy * s, m.xz * s, m.yy * s, m.yz * s, m.zz * s};
}

template <class T>
Six<T> square(const Six<T>& m) {
  const auto sum = [](T a, T b, T c, T d, T e, T f) { return mul_add(a, b, mul_add(c, d, e * f)); };
  return {sum(m.xx, m.xx, m.xy, m.xy, m.xz, m.xz), sum(m.xx, m.xy, m.xy, m.yy, m.xz, m.yz),
          sum(m.xx, m.xz, m.xy, m.yz, m.xz, m.zz), sum(m.yy, m.yy, m.xy, m.xy, m.yz, m.yz),
          sum(m.xy, m.xz, m.yy, m.yz, m.yz, m.zz), sum(m.zz, m.zz, m.xz, m.xz, m.yz, m.yz)};
}

template <class T>
bool is_finite(const Six<T>& m) {
  return m.xx * 0 + m.xy * 0 + m.xz * 0 + m.yy * 0 + m.yz * 0 + m.zz * 0 == 0;
}

/// m e^(x + rest) for any x; over- and underflow entry by entry. Four factors, because 2^n alone may be out
/// of range.
template <class T>
Six<T> times_exp(const Six<T>& m, T x, T rest) {
  using C = Tables<T>;
  x = x > C::exponent_limit ? C::exponent_limit : x < -C::exponent_limit ? -C::exponent_limit : x;
  const Reduced<T> e = reduce(x);
  const int n = static_cast<int>(e.n), quarter = n / 4;
  const auto power = [](int k) { return add_to_exponent(T(1), static_cast<typename C::Bits>(k)); };
  Six<T> out = times(m, scaled_exp(e.r + rest, T(1)));
  for (int i = 0; i < 3; ++i) out = times(out, power(quarter));
  return times(out, power(n - 3 * quarter));
}

template <class T>
bool is_diagonal(const Six<T>& a) {
  return a.xy == 0 && a.xz == 0 && a.yz == 0;
}

/// Any input; out of line, so that the fast path stays small.
template <class T>
[[gnu::noinline]] void exp_general(const T* in, T* out) {
  using C = Tables<T>;
  const Split<T> s = split(in);
  T p = invariants(s.a).p, scale = 1;
  int squarings = 0;
  for (; p > C::p_limit && squarings <= C::max_squarings; ++squarings) p /= 4, scale /= 2;
  if (!(p <= C::p_limit) || squarings > C::max_squarings || is_diagonal(s.a)) return exp_by_jacobi(in, out);
  const Invariants<T> v = invariants(times(s.a, scale));
  const Coefficients<T> z = recurrence(v.p, v.q);
  Six<T> m = combine({z.z0 * C::lead, z.z1 * C::lead, z.z2 * C::lead}, v.a, v.c);
  for (int k = 0; k < squarings; ++k) m = square(m);
  m = times_exp(m, s.mean, s.rest);
  if (!is_finite(m)) return exp_by_jacobi(in, out);
  store(m, out);
}

template <class T>
inline void exp_one(const T* in, T* out) {
  using C = Tables<T>;
  const Split<T> s = split(in);
  const Invariants<T> v = invariants(s.a);
  if (!(v.p <= C::p_limit && s.trace <= C::trace_limit && s.trace >= -C::trace_limit)) [[unlikely]] {
    return exp_general(in, out);
  }
  const Reduced<T> e = reduce(s.mean);
  const T factor = add_to_exponent(scaled_exp(e.r + s.rest, C::lead), e.n_bits);
  const Coefficients<T> z = recurrence(v.p, v.q);
  store(combine({z.z0 * factor, z.z1 * factor, z.z2 * factor}, v.a, v.c), out);
}

template <class T>
inline void exp_many(const T* in, T* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) exp_one(in + 6 * i, out + 6 * i);
}

}  // namespace

void exp(const double* in, double* out, std::size_t count) {
  exp_many(in, out, count);
}
void exp(const float* in, float* out, std::size_t count) {
  exp_many(in, out, count);
}

}  // namespace viete::sym3::VIETE_KERNEL_NAMESPACE
