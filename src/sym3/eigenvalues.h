// Eigenvalues of symmetric 3x3 matrices, by QR and by Viete's trigonometric formula.
#pragma once

#include <array>

#include "sym3/sym3.h"

namespace viete::sym3 {

/// Ascending, by QR (Eigen's SelfAdjointEigenSolver::compute, values only), T = float or double. Each is
/// wrong by at most 24 u times the largest in size (u = 2^-53 or 2^-24). A NaN or an infinity in S gives
/// three NaN.
template <class T>
std::array<T, 3> eigenvalues_qr(const Sym3<T>& s);

/// Ascending, closed form (paper, section 3), k clamped to [-1, 1] and r = 0 handled. Each is wrong by at
/// most 4 cbrt(u) times the largest in size: that much near triple eigenvalues, some sqrt(u) near double
/// ones, some 100 u for separate ones. Entries between 1e-50 and 1e50 in size (float: 1e-6 and 1e6): cubes
/// must be in range. A NaN or an infinity in S gives three NaN.
template <class T>
std::array<T, 3> eigenvalues_viete(const Sym3<T>& s);

}  // namespace viete::sym3
