// log and inverse square root of positive definite symmetric 3x3 matrices.
#pragma once

#include "sym3/sym3.h"

namespace viete::sym3 {

// By Jacobi's eigenvectors, in double for either T, in double-double where eigenvalues differ by more than
// a factor of about 8 to 16. Relative error, Frobenius norm: <= 24 u for log in double, also where log S is
// small; <= 24 u for the inverse square root; <= 1.5 u of float. At any gap, and for conditions up to 1e15.
// A matrix that is not positive definite, or has a NaN or an infinity, gives NaN in all six. Some 0.5 us,
// 2.5 us in double-double. Thread-safe.

/// The symmetric X with exp(X) = S, for positive definite S.
template <class T>
Sym3<T> log(const Sym3<T>& s);

/// The positive definite matrix X with X X S = I, for positive definite S.
template <class T>
Sym3<T> inv_sqrt(const Sym3<T>& s);

}  // namespace viete::sym3
