// Derivatives of exp, log, square root and powers of symmetric 3x3 matrices: in one direction, in several, or
// in all six; for one matrix or for many.
//
// f'(S)[E] = lim (f(S + h E) - f(S)) / h is the directional (Frechet) derivative of f at S in the direction
// E: symmetric, linear in E, and self-adjoint, tr(F f'(S)[E]) = tr(E f'(S)[F]), so it is its own reverse
// mode. With eigenvectors V and eigenvalues x_i it is V (F o V^T E V) V^T, F_ij = (f(x_i) - f(x_j)) / (x_i -
// x_j), or f'(x_i) if they are equal. No formula here subtracts close values: equal eigenvalues are as
// accurate as any others.
//
// exp: the recurrence of method `fast`, differentiated (exp_derivative-inl.h): no eigenvalues, no division.
// The others: eigenvectors and divided differences (spectral_derivative-inl.h).
//
// Error in the Frobenius norm, relative to |f'(S)| |E|, |f'(S)| the largest F_ij; u is 2^-53 or 2^-24, spread
// the largest eigenvalue minus the smallest, k the one over the other:
//   exp        <= (6 + 2 spread) u with fused multiply-add, (8 + 2.5 spread) u without, at any trace
//   log, sqrt  <= (16 + 2 k) u
//   pow        <= (16 + 4 (1 + |p|) k + 4 |p log S|) u
// at any gap between eigenvalues; inputs for which log.h uses Jacobi's eigenvectors, or S^p is outside
// e^(+-500) (float e^(+-50)), have <= 16 (1 + |p|) u and take some 5 us. The bounds are empirical: tests/sym3
// verifies them against 113 bits.
//
// NaN or an infinity in S or E gives six NaN; so does an S that is not positive definite, for log, sqrt and
// pow. (The root has no derivative at an eigenvalue 0.) For other finite numbers exp gives no NaN: an entry
// that overflows becomes a signed infinity, without effect on other entries; underflow is gradual. Powers
// that overflow are infinite or NaN. Thread-safe; no allocation, no throw.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "sym3/batch.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

template <class T>
Sym3<T> exp_derivative(const Sym3<T>& s, const Sym3<T>& direction);
/// S must be positive definite, here and in the next two.
template <class T>
Sym3<T> log_derivative(const Sym3<T>& s, const Sym3<T>& direction);
template <class T>
Sym3<T> sqrt_derivative(const Sym3<T>& s, const Sym3<T>& direction);
/// The derivative of S^p, any finite p.
template <class T>
Sym3<T> pow_derivative(const Sym3<T>& s, double p, const Sym3<T>& direction);

/// The derivatives in all six directions: number k has the direction in which the k-th number of Sym3 is 1
/// and the others are 0. The j-th number of [k] is thus the derivative of the j-th number of f(S) by the k-th
/// number of S; for k = xy, xz or yz both off-diagonal entries change by 1. The order is that of Sym3: xx xy
/// xz yy yz zz (for Voigt order see eigen.h). Equal to the single derivatives up to rounding.
template <class T>
using Tangent = std::array<Sym3<T>, 6>;

template <class T>
Tangent<T> exp_tangent(const Sym3<T>& s);
template <class T>
Tangent<T> log_tangent(const Sym3<T>& s);
template <class T>
Tangent<T> sqrt_tangent(const Sym3<T>& s);
template <class T>
Tangent<T> pow_tangent(const Sym3<T>& s, double p);

// Batches. With several directions, number i of out[k] is the derivative at number i of `s` in the direction
// that is number i of directions[k]; direction-independent work is done once.
//   const SymView<const double> directions[] = {e0, e1, e2};
//   const SymView<double> out[] = {f0, f1, f2};
//   exp_derivative(s, directions, out, count);
// out.size() == directions.size(). Any layout of view.h for each view; planes are fastest. out[k] may be the
// same view as directions[k] or as `s`, and must not overlap any other view. Each result has the bits of the
// single call under that kernel.

template <class T>
using Directions = std::span<const SymView<const T>>;
template <class T>
using Derivatives = std::span<const SymView<T>>;

/// Number j in direction k of a tangent is entry 6 k + j. Any layout but `full`.
template <class T>
using TangentView = View<T, 36>;

void exp_derivative(const SymView<const double>& s, Directions<double> directions, Derivatives<double> out,
                    std::size_t count, const Batch& batch = {});
void log_derivative(const SymView<const double>& s, Directions<double> directions, Derivatives<double> out,
                    std::size_t count, const Batch& batch = {});
void sqrt_derivative(const SymView<const double>& s, Directions<double> directions, Derivatives<double> out,
                     std::size_t count, const Batch& batch = {});
void pow_derivative(const SymView<const double>& s, double p, Directions<double> directions,
                    Derivatives<double> out, std::size_t count, const Batch& batch = {});
void exp_derivative(const SymView<const float>& s, Directions<float> directions, Derivatives<float> out,
                    std::size_t count, const Batch& batch = {});
void log_derivative(const SymView<const float>& s, Directions<float> directions, Derivatives<float> out,
                    std::size_t count, const Batch& batch = {});
void sqrt_derivative(const SymView<const float>& s, Directions<float> directions, Derivatives<float> out,
                     std::size_t count, const Batch& batch = {});
void pow_derivative(const SymView<const float>& s, double p, Directions<float> directions,
                    Derivatives<float> out, std::size_t count, const Batch& batch = {});
void exp_tangent(const SymView<const double>& s, const TangentView<double>& out, std::size_t count,
                 const Batch& batch = {});
void log_tangent(const SymView<const double>& s, const TangentView<double>& out, std::size_t count,
                 const Batch& batch = {});
void sqrt_tangent(const SymView<const double>& s, const TangentView<double>& out, std::size_t count,
                  const Batch& batch = {});
void pow_tangent(const SymView<const double>& s, double p, const TangentView<double>& out, std::size_t count,
                 const Batch& batch = {});
void exp_tangent(const SymView<const float>& s, const TangentView<float>& out, std::size_t count,
                 const Batch& batch = {});
void log_tangent(const SymView<const float>& s, const TangentView<float>& out, std::size_t count,
                 const Batch& batch = {});
void sqrt_tangent(const SymView<const float>& s, const TangentView<float>& out, std::size_t count,
                  const Batch& batch = {});
void pow_tangent(const SymView<const float>& s, double p, const TangentView<float>& out, std::size_t count,
                 const Batch& batch = {});

}  // namespace viete::sym3
