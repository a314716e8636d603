// exp in more than double precision: a slow reference for error measurements.
#pragma once

#include "sym3/sym3.h"

namespace viete::sym3 {

/// Returns exp(S), computed by a Taylor polynomial and squarings in double-double, in about 2 us. The
/// relative error in the Frobenius norm is below 1e-28 for spreads up to 1000 (tested against 113 bits).
/// Results below 1e-270 are less accurate, because the low parts underflow. NaN or entries above 1e6 in size
/// give NaN. If the result overflows, it has infinities. Thread-safe.
Sym3<DoubleDouble> exp_reference(const Sym3<double>& s);

/// Returns |computed - exp(S)| / |exp(S)| in Frobenius norms, with exp_reference(). Returns NaN if a matrix
/// has a NaN or if exp(S) is outside the range of double.
double relative_error(const Sym3<double>& computed, const Sym3<double>& s);

}  // namespace viete::sym3
