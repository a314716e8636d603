// Eigenvalues of symmetric 3x3 matrices: in closed form and accurate, by QR, and by Viete's formula as in the
// paper.
#pragma once

#include <array>

#include "sym3/batch.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

/// Ascending, in closed form with the discriminant as a sum of squares (spectral-inl.h). Each has an error of
/// at most 8 u times the largest in size, u = 2^-53 or 2^-24, at any gap: clusters are as accurate as
/// separate ones. Any finite matrix. A NaN or an infinity in S gives three NaN.
template <class T>
std::array<T, 3> eigenvalues(const Sym3<T>& s);

/// The same for many: the bits of the single call under that kernel. Any layout; `in` and `out` must not
/// overlap.
void eigenvalues(const SymView<const double>& in, const VecView<double>& out, std::size_t count,
                 const Batch& batch = {});
void eigenvalues(const SymView<const float>& in, const VecView<float>& out, std::size_t count,
                 const Batch& batch = {});

/// Ascending, by QR (Eigen's SelfAdjointEigenSolver::compute, values only), T = float or double. Each has
/// an error of at most 24 u times the largest in size (u = 2^-53 or 2^-24). A NaN or an infinity in S gives
/// three NaN.
template <class T>
std::array<T, 3> eigenvalues_qr(const Sym3<T>& s);

/// Ascending, closed form (paper, section 3), k clamped to [-1, 1] and r = 0 handled. Each has an error of at
/// most 4 cbrt(u) times the largest in size: that much near triple eigenvalues, some sqrt(u) near double
/// ones, some 100 u for separate ones. Entries between 1e-50 and 1e50 in size (float: 1e-6 and 1e6): cubes
/// must be in range. A NaN or an infinity in S gives three NaN.
template <class T>
std::array<T, 3> eigenvalues_viete(const Sym3<T>& s);

}  // namespace viete::sym3
