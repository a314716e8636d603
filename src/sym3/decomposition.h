// Eigenvectors of symmetric matrices, and singular value decompositions of general matrices.
#pragma once

#include <cstddef>

#include "sym3/batch.h"
#include "sym3/rotation.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

// u is 2^-53 for double and 2^-24 for float; errors of matrices are Frobenius norms. Rotations are proper:
// their determinant is 1. Column k of a matrix m has the entries m[k], m[3 + k], m[6 + k]. If several
// components of a column have the largest absolute value, the sign rules below refer to the first of them.
// All functions are thread-safe, do not allocate and do not throw. Batches have the same bits as single calls
// with the same kernel; all layouts except `full` of general matrices are allowed, and planes are fastest.
// Outputs must not overlap inputs or each other.

/// S = V diag(values) V^T.
template <class T>
struct Eigensystem {
  Vec3<T> values;   ///< in ascending order; the same bits as eigenvalues()
  Mat3<T> vectors;  ///< V, a rotation: column k is the eigenvector of values[k]
};

/// Returns eigenvalues and eigenvectors of any finite matrix, by a closed form (spectral-inl.h).
///
/// Errors, for any distances between eigenvalues: values 8 u of the largest absolute eigenvalue; |V^T V - I|
/// <= 20 u; |V diag(values) V^T - S| <= 24 u |S|. The angle between a computed and an exact eigenvector is
/// about u |S| / gap, where gap is the distance to the nearest other eigenvalue. For equal eigenvalues, the
/// vectors are an orthonormal basis of the eigenspace. Sign: the largest component of the vectors 1 and 2 is
/// positive; vector 0 completes the rotation. S = 0 gives V = I. A NaN or an infinity in S gives twelve NaN.
template <class T>
Eigensystem<T> eigh(const Sym3<T>& s);

void eigh(const SymView<const double>& in, const VecView<double>& values, const MatView<double>& vectors,
          std::size_t count, const Batch& batch = {});
void eigh(const SymView<const float>& in, const VecView<float>& values, const MatView<float>& vectors,
          std::size_t count, const Batch& batch = {});

/// M = U diag(values) V^T.
template <class T>
struct SingularSystem {
  Mat3<T> u;  ///< a rotation
  /// values[0] >= values[1] >= |values[2]|. The last value has the sign of det M.
  Vec3<T> values;
  Mat3<T> v;  ///< a rotation
};

/// Returns the singular value decomposition of any finite matrix, by one-sided Jacobi rotations of its
/// columns.
///
/// Errors: |U^T U - I| and |V^T V - I| <= 24 u; |U diag(values) V^T - M| <= 16 u |M|. If M = B D, where D is
/// diagonal and B has columns of length 1 and condition number k, each singular value has a *relative* error
/// of at most 16 u k, even if D spans many orders of magnitude: stretched axes keep their small lengths.
/// Values below 1e-290 (float 1e-36) of the largest have no relative accuracy. Sign: the largest component of
/// the columns 0 and 1 of V is positive; the last columns of U and V complete the rotations. M = 0 gives U =
/// V = I. A NaN or an infinity in M gives 21 NaN.
template <class T>
SingularSystem<T> svd(const Mat3<T>& m);

void svd(const MatView<const double>& in, const MatView<double>& u, const VecView<double>& values,
         const MatView<double>& v, std::size_t count, const Batch& batch = {});
void svd(const MatView<const float>& in, const MatView<float>& u, const VecView<float>& values,
         const MatView<float>& v, std::size_t count, const Batch& batch = {});

}  // namespace viete::sym3
