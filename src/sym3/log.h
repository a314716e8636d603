// log, square roots and powers of positive definite symmetric 3x3 matrices, for one matrix or a batch.
//
// The functions use eigenvalues in closed form and divided differences (spectral-inl.h). A single call takes
// 70 to 120 ns; in a batch each matrix takes about 10 ns. u is 2^-53 for double and 2^-24 for float; k is the
// condition number: the largest divided by the smallest eigenvalue. The error relative to the norm of the
// result is, for any gaps between eigenvalues:
//   log        <= 6 u max(1, k / |log S|); <= 16 u for k up to 10
//   sqrt       <= 6 u sqrt(k)
//   inv_sqrt   <= 8 u k
//   pow        <= 8 u (|p| k + 1 + |p log S|), for results in the normal range
// If k is above 2^33 (float 2^12), or an eigenvalue is outside 1e-80 .. 1e80 (float 1e-9 .. 1e9), log and the
// roots use Jacobi's eigenvectors. Then the error is at most 24 u (float 1.5 u) for k up to 1e15, and a call
// takes 0.5 to 2.5 us.
//
// A matrix that is not positive definite, or has a NaN or an infinity, gives six NaN. Exception: sqrt treats
// negative eigenvalues above -16 u * largest entry as 0. The bounds are empirical: tests/sym3 verifies them
// against results with 113 bits. Thread-safe; no allocation, no throw.
#pragma once

#include "sym3/batch.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

/// Returns the symmetric X with exp(X) = S. S must be positive definite.
template <class T>
Sym3<T> log(const Sym3<T>& s);

/// Computes log by full QR diagonalisation, as a reference. The error is at most 24 u max(1, k / |log S|).
template <class T>
Sym3<T> log_qr(const Sym3<T>& s);

/// Returns the positive semi-definite X with X X = S.
template <class T>
Sym3<T> sqrt(const Sym3<T>& s);

/// Returns the positive definite X with X X S = I.
template <class T>
Sym3<T> inv_sqrt(const Sym3<T>& s);

/// Returns exp(p * log S). S must be positive definite. p is first rounded to T. If p or an entry of p log S
/// is then outside the range of T, the result is six NaN.
template <class T>
Sym3<T> pow(const Sym3<T>& s, double p);

// Batches. Each result has the same bits as a single call with the same kernel. All layouts are allowed. `in`
// and `out` must either be equal or not overlap.

void log(const SymView<const double>& in, const SymView<double>& out, std::size_t count,
         const Batch& batch = {});
void log(const SymView<const float>& in, const SymView<float>& out, std::size_t count,
         const Batch& batch = {});
void sqrt(const SymView<const double>& in, const SymView<double>& out, std::size_t count,
          const Batch& batch = {});
void sqrt(const SymView<const float>& in, const SymView<float>& out, std::size_t count,
          const Batch& batch = {});
void inv_sqrt(const SymView<const double>& in, const SymView<double>& out, std::size_t count,
              const Batch& batch = {});
void inv_sqrt(const SymView<const float>& in, const SymView<float>& out, std::size_t count,
              const Batch& batch = {});
void pow(const SymView<const double>& in, double p, const SymView<double>& out, std::size_t count,
         const Batch& batch = {});
void pow(const SymView<const float>& in, double p, const SymView<float>& out, std::size_t count,
         const Batch& batch = {});

}  // namespace viete::sym3
