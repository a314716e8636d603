// exp to more than double precision, as a slow reference for error measurements.
#pragma once

#include "sym3/sym3.h"

namespace viete::sym3 {

/// exp(S) with a relative Frobenius error below 1e-28 for spreads up to 1000 (tested against 113 bits), if it
/// is above 1e-270; below, the low parts underflow. Double-double Taylor polynomial and squaring, some 2 us.
/// Entries of S up to 1e6 in size; otherwise, and for NaN, all NaN. Overflow gives infinities. Thread-safe.
Sym3<DoubleDouble> exp_reference(const Sym3<double>& s);

/// |computed - exp(S)| / |exp(S)|, Frobenius norms, against exp_reference. NaN if either is NaN or exp(S) is
/// outside the range of double.
double relative_error(const Sym3<double>& computed, const Sym3<double>& s);

}  // namespace viete::sym3
