// exp of symmetric 3x3 matrices: the paper's methods, and a faster and more accurate one.
//
// u is the unit roundoff, 2^-53 for double and 2^-24 for float; spread is the largest eigenvalue minus the
// smallest; errors are relative, in the Frobenius norm, for results in the normal range. The bounds are
// empirical: tests/sym3 pins them against 113 bits. All functions are pure, allocate nothing, throw nothing,
// and may be called from any number of threads; round-to-nearest and no flush-to-zero are assumed.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "sym3/batch.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

/// How exp is computed. The first three are the paper's; `fast` is ours, and the default everywhere.
///
/// Special values, all methods but improved_sd_faithful: a NaN or an infinity anywhere gives six NaN; the
/// zero matrix gives exactly I. Overflow: see each.
enum class Method {
  /// Full diagonalisation by QR (Eigen's SelfAdjointEigenSolver::compute). Error <= (20 + 20 |S|) u, |S| the
  /// largest eigenvalue in size. Where an exponential overflows, infinities and NaN.
  diag,

  /// The paper's spectral form x I + y S + z S^2, eigenvalues by QR, three cases by a gap of 1e-6. No
  /// useful bound: the weights lose digits as gaps shrink. On the paper's ensemble some 1e3 u; in double,
  /// relative errors up to 4e-3 for three eigenvalues 1e-6 apart; in float, where 1e-6 is the level of
  /// rounding, of any size. Infinities and NaN already where a term of x, y, z overflows.
  sd,

  /// The same with Viete's closed-form eigenvalues, guarded: k clamped to [-1, 1], r = 0 handled. As accurate
  /// as sd, or worse by the rounding errors of the closed form. Never NaN for finite input in whose terms
  /// nothing
  /// overflows.
  improved_sd,

  /// As printed but for the misprints: NaN for S = c I, for half of all matrices with a double eigenvalue,
  /// and for some with close ones. For comparison only.
  improved_sd_faithful,

  /// Shift by the mean eigenvalue, then a recurrence in two invariants (exp-inl.h). Error <= (6 + 2
  /// spread) u with fused multiply-add, (8 + 2.5 spread) u without, at any trace and any gap; <= 6 u for
  /// spread <= 3 and <= 8 u on the paper's ensemble with it. Finite input never gives NaN: where an entry
  /// overflows, that entry alone is a signed infinity, diag(710, 0, 0) -> (inf, 1, 1); underflow is
  /// gradual. Entries far below the norm are accurate relative to the norm only, but for diagonal S of spread
  /// above 6 (float 8), where each is by itself.
  fast,
};

/// What there is to say of a method.
struct MethodEntry {
  Method method;
  const char* name;      ///< stable, for command lines and files: "improved_sd"
  const char* label;     ///< for people: "Improved SD"
  const char* sentence;  ///< how it works
};

/// All methods, in the order of the enumeration.
std::span<const MethodEntry> methods();
std::string_view name(Method method);
std::string_view label(Method method);
std::optional<Method> method_from_name(std::string_view name);

/// exp(S), T = float or double.
template <class T>
Sym3<T> exp(const Sym3<T>& s, Method method = Method::fast);

/// exp of many; in.size() == out.size(); in and out may be the same span, else must not overlap. Each answer
/// has the same bits as the single call.
template <class T>
void exp(std::span<const Sym3<T>> in, std::span<Sym3<T>> out, Method method = Method::fast);

/// exp of `count` matrices by method `fast`, from any layout of view.h to any (the same one is faster). In
/// place where `in` and `out` are the same view; else they must not overlap. Each answer has the bits of the
/// single call under that kernel, wherever it stands and on however many threads.
void exp(const SymView<const double>& in, const SymView<double>& out, std::size_t count,
         const Batch& batch = {});
void exp(const SymView<const float>& in, const SymView<float>& out, std::size_t count,
         const Batch& batch = {});

}  // namespace viete::sym3
