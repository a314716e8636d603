// log, square roots and powers of positive definite symmetric 3x3 matrices, single or in batches.
//
// By eigenvalues in closed form and divided differences (spectral-inl.h): some 70 to 120 ns for one, some 10
// ns each for many. k is the condition number, the largest eigenvalue over the smallest. Error, relative to
// the norm of the result f(S):
//   log        <= 6 u max(1, k / |log S|), as the conditioning of log; <= 16 u for k up to 10
//   sqrt       <= 6 u sqrt k
//   inv_sqrt   <= 8 u k
//   pow        <= 8 u (|p| k + 1 + |p log S|), for results in the normal range
// at any gap between eigenvalues. If k is above 2^33 (float 2^12), or eigenvalues are outside 1e-80 .. 1e80
// (float 1e-9 .. 1e9), log and the roots use Jacobi's eigenvectors: error <= 24 u (float 1.5 u) for
// conditions up to 1e15, some 0.5 to 2.5 us.
//
// A matrix that is not positive definite, or has a NaN or an infinity, gives six NaN; but sqrt treats
// eigenvalues that are zero, or negative within rounding (16 u of the largest entry), as zero. u is 2^-53 or
// 2^-24. The bounds are empirical: tests/sym3 verifies them against 113 bits. Thread-safe; no allocation, no
// throw.
#pragma once

#include "sym3/batch.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

/// The symmetric X with exp(X) = S, for positive definite S.
template <class T>
Sym3<T> log(const Sym3<T>& s);

/// The same by full QR diagonalisation, as a reference. Error <= 24 u max(1, k / |log S|).
template <class T>
Sym3<T> log_qr(const Sym3<T>& s);

/// The positive semi-definite X with X X = S.
template <class T>
Sym3<T> sqrt(const Sym3<T>& s);

/// The positive definite X with X X S = I.
template <class T>
Sym3<T> inv_sqrt(const Sym3<T>& s);

/// exp(p log S), any finite p, for positive definite S.
template <class T>
Sym3<T> pow(const Sym3<T>& s, double p);

// Batches: each result has the bits of the single call under that kernel. Any layouts of view.h; `in` and
// `out` may be the same view, otherwise must not overlap.

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
