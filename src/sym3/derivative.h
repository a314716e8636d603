// Derivatives of exp, log, square root and powers of symmetric 3x3 matrices, in one or more directions.
//
// f'(S)[E] = lim (f(S + h E) - f(S)) / h is the directional (Frechet) derivative of f at S in the
// direction E. This matrix is symmetric and linear in E. Because tr(G f'(S)[E]) = tr(E f'(S)[G]), f'(S)[G] is
// also the reverse-mode derivative for a gradient G.
//
// Let the columns of V be the eigenvectors of S, and x_i the eigenvalues. Then
//   f'(S)[E] = V (F o V^T E V) V^T,   F_ij = (f(x_i) - f(x_j)) / (x_i - x_j), or f'(x_i) if x_i = x_j,
// where o multiplies entry by entry. The code never subtracts close values, so close eigenvalues lose no
// accuracy. exp uses the differentiated recurrence of method `fast` (exp_derivative-inl.h). The other
// functions use eigenvectors (derivative_kernel.cpp).
//
// Errors are relative to |f'(S)| |E|, where |f'(S)| is the largest |F_ij| and |E| is the Frobenius norm. u is
// 2^-53 for double and 2^-24 for float. The spread is the largest minus the smallest eigenvalue, and k is the
// largest divided by the smallest eigenvalue. The bounds do not depend on the gaps between eigenvalues:
//   exp        <= (6 + 2 spread) u with fused multiply-add, (8 + 2.5 spread) u without, at any trace
//   log, sqrt  <= (16 + 2 k) u
//   pow        <= (16 + 4 (1 + |p|) k + 4 |p log S|) u
// If log.h uses Jacobi's eigenvectors for S, or an eigenvalue of S^p is outside e^(+-500) (float e^(+-50)),
// the bound of log, sqrt and pow is 16 (1 + |p|) u, and a derivative takes about 5 us. The bounds are
// empirical: tests/sym3 verifies them against results with 113 bits.
//
// If S or E has a NaN or an infinity, the result is six NaN. If S is not positive definite, log, sqrt and pow
// also give six NaN. For finite S and E, exp gives no NaN: an entry that overflows becomes a signed infinity
// and leaves other entries unchanged, and underflow is gradual. Powers that overflow are infinite or NaN.
// Thread-safe; no allocation, no throw.
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
/// For log, sqrt and pow, S must be positive definite.
template <class T>
Sym3<T> log_derivative(const Sym3<T>& s, const Sym3<T>& direction);
template <class T>
Sym3<T> sqrt_derivative(const Sym3<T>& s, const Sym3<T>& direction);
/// Returns the derivative of S^p for any finite p.
template <class T>
Sym3<T> pow_derivative(const Sym3<T>& s, double p, const Sym3<T>& direction);

/// The derivatives in six directions, in the order of Sym3: xx xy xz yy yz zz. Entry j of element k is the
/// derivative of entry j of f(S) with respect to entry k of S. Directions xy, xz and yz change the entries
/// above and below the diagonal. The elements are equal to single derivatives up to rounding. For Voigt order
/// see eigen.h.
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

// Batches. Item i of out[k] is the derivative at item i of `s`, in the direction of item i of directions[k].
// Data that depends only on `s` is computed only once:
//   const SymView<const double> directions[] = {e0, e1, e2};
//   const SymView<double> out[] = {f0, f1, f2};
//   exp_derivative(s, directions, out, count);
// The sizes of `directions` and `out` must be equal. All layouts are allowed; planes are fastest. out[k] may
// be equal to directions[k] or to `s`, and must not overlap any other view. Each result has the same bits as
// a single call with the same kernel.

template <class T>
using Directions = std::span<const SymView<const T>>;
template <class T>
using Derivatives = std::span<const SymView<T>>;

/// Entry 6 * k + j of an item is entry j of element k of a Tangent. The layout must not be `full`.
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
