// Eigenvalues of symmetric 3x3 matrices: by an accurate closed form, by QR, and by the paper's formula.
#pragma once

#include <array>

#include "sym3/batch.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

// u is 2^-53 for double and 2^-24 for float. Eigenvalues are in ascending order, and errors are relative to
// the largest absolute eigenvalue. A NaN or an infinity in S gives three NaN.

/// Returns the eigenvalues of any finite matrix by a closed form with the discriminant as a sum of squares
/// (spectral-inl.h). The error is at most 8 u, even if eigenvalues are close.
template <class T>
std::array<T, 3> eigenvalues(const Sym3<T>& s);

/// Computes the eigenvalues of many matrices, with the same bits as single calls with the same kernel. All
/// layouts are allowed. `in` and `out` must not overlap.
void eigenvalues(const SymView<const double>& in, const VecView<double>& out, std::size_t count,
                 const Batch& batch = {});
void eigenvalues(const SymView<const float>& in, const VecView<float>& out, std::size_t count,
                 const Batch& batch = {});

/// Returns the eigenvalues by QR (Eigen's SelfAdjointEigenSolver::compute). The error is at most 24 u.
template <class T>
std::array<T, 3> eigenvalues_qr(const Sym3<T>& s);

/// Returns the eigenvalues by Viete's formula (paper, section 3). The argument of the arc cosine is clamped
/// to [-1, 1], and triple eigenvalues are a separate case. The error is about 100 u for separate eigenvalues,
/// about sqrt(u) close to a double eigenvalue, and up to 4 cbrt(u) close to a triple eigenvalue. Entries must
/// be between 1e-50 and 1e50 in absolute value (float 1e-6 and 1e6), so that their cubes are in range.
template <class T>
std::array<T, 3> eigenvalues_viete(const Sym3<T>& s);

}  // namespace viete::sym3
