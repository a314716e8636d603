// exp of symmetric 3x3 matrices: the paper's methods, and a faster and more accurate one.
//
// u is the unit roundoff, 2^-53 for double and 2^-24 for float; spread is the largest eigenvalue minus the
// smallest; errors are relative, in the Frobenius norm, for results in the normal range. The bounds are
// empirical: tests/sym3 verifies them against 113 bits. All functions are pure and thread-safe, do not
// allocate and do not throw; they assume round-to-nearest and no flush-to-zero.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "sym3/batch.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

/// Methods for exp. The first three are the paper's; `fast` is ours and the default.
///
/// Special values, for all methods except improved_sd_faithful: a NaN or an infinity in S gives six NaN; the
/// zero matrix gives exactly I. Overflow: see each.
enum class Method {
  /// Full diagonalisation by QR (Eigen's SelfAdjointEigenSolver::compute). Error <= (20 + 20 |S|) u, |S| the
  /// largest eigenvalue in size. Infinities and NaN if an exponential overflows.
  diag,

  /// The paper's spectral form x I + y S + z S^2 with eigenvalues by QR; a gap of 1e-6 separates its three
  /// cases. No useful error bound, since x, y and z lose digits as gaps shrink: about 1e3 u on the paper's
  /// ensemble; for three eigenvalues 1e-6 apart up to 4e-3 in double and unlimited in float, where 1e-6 is
  /// the rounding level (relative errors). Infinities and NaN if a term of x, y, z overflows.
  sd,

  /// The same with Viete's closed-form eigenvalues, guarded: k clamped to [-1, 1], r = 0 handled. As accurate
  /// as sd, or worse by the rounding errors of the closed form. Never NaN for finite input whose terms do not
  /// overflow.
  improved_sd,

  /// As printed, with the misprints corrected: NaN for S = c I, for half of all matrices with a double
  /// eigenvalue, and for some with close ones. For comparison only.
  improved_sd_faithful,

  /// Shift by the mean eigenvalue, then a recurrence in two invariants (exp-inl.h). Error <= (6 + 2 spread) u
  /// with fused multiply-add, (8 + 2.5 spread) u without, at any trace and any gap; with it <= 6 u for spread
  /// <= 3, and <= 8 u on the paper's ensemble. Finite input never gives NaN: an entry that overflows becomes
  /// a signed infinity, without effect on others, diag(710, 0, 0) -> (inf, 1, 1); underflow is gradual.
  /// Entries far below the norm are accurate only relative to the norm, except for diagonal S of spread above
  /// 6 (float 8), whose entries are accurate individually.
  fast,
};

/// Name and description of a method.
struct MethodEntry {
  Method method;
  const char* name;      ///< stable, for command lines and files: "improved_sd"
  const char* label;     ///< display name: "Improved SD"
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

/// exp of many; in.size() == out.size(); in and out may be the same span, otherwise must not overlap. Each
/// result has the same bits as the single call.
template <class T>
void exp(std::span<const Sym3<T>> in, std::span<Sym3<T>> out, Method method = Method::fast);

/// exp of `count` matrices by method `fast`, between any layouts of view.h (equal layouts are faster). `in`
/// and `out` may be the same view, otherwise must not overlap. Each result has the bits of the single call
/// under that kernel, for any position and number of threads.
void exp(const SymView<const double>& in, const SymView<double>& out, std::size_t count,
         const Batch& batch = {});
void exp(const SymView<const float>& in, const SymView<float>& out, std::size_t count,
         const Batch& batch = {});

}  // namespace viete::sym3
