// exp to more than double precision, slowly: what errors are measured against.
#pragma once

#include "sym3/sym3.h"

namespace viete::sym3 {

/// exp(S) with a relative Frobenius error below 1e-28 for spreads up to 1000 (tested against 113 bits), as
/// long as it is above 1e-270: below, the low parts underflow. Double-double Taylor polynomial and squaring,
/// some 2 us. Entries of S up to 1e6 in size; else, and for NaN, all NaN. Overflow gives infinities.
/// Thread-safe.
Sym3<DoubleDouble> exp_reference(const Sym3<double>& s);

/// |computed - exp(S)| / |exp(S)|, Frobenius norms, against exp_reference. NaN where either is NaN or exp(S)
/// is not in the range of double.
double relative_error(const Sym3<double>& computed, const Sym3<double>& s);

}  // namespace viete::sym3
