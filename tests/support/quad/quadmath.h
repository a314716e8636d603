// Replaces libquadmath on arm64, where GCC does not have this library and long double has 113 bits.
#pragma once

#include <cfloat>
#include <cmath>

static_assert(LDBL_MANT_DIG == 113);
typedef long double __float128;

#define VIETE_QUAD(name)                      \
  inline long double name##q(long double x) { \
    return std::name(x);                      \
  }
VIETE_QUAD(acos)
VIETE_QUAD(asin)
VIETE_QUAD(atan) VIETE_QUAD(atanh) VIETE_QUAD(cos) VIETE_QUAD(cosh) VIETE_QUAD(exp) VIETE_QUAD(expm1)
    VIETE_QUAD(fabs) VIETE_QUAD(log) VIETE_QUAD(log1p) VIETE_QUAD(sin) VIETE_QUAD(sinh) VIETE_QUAD(sqrt)
#undef VIETE_QUAD
        inline long double atan2q(long double y, long double x) {
  return std::atan2(y, x);
}
inline long double powq(long double x, long double p) {
  return std::pow(x, p);
}
inline long double scalbnq(long double x, int n) {
  return std::scalbn(x, n);
}
inline int ilogbq(long double x) {
  return std::ilogb(x);
}

#define M_PIq 3.141592653589793238462643383279502884L
#define M_LN2q 0.693147180559945309417232121458176568L
