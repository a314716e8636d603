// exp of symmetric 3x3 matrices: the methods of the paper, and a method that is faster and more accurate.
//
// u is the unit roundoff, 2^-53 for double and 2^-24 for float. The spread is the largest eigenvalue minus
// the smallest. Errors are relative, in the Frobenius norm, for results in the normal range. The bounds are
// empirical: tests/sym3 verifies them against results with 113 bits. All functions are thread-safe, do not
// allocate and do not throw. The functions assume that the processor rounds to nearest and does not flush to
// zero.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "sym3/batch.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

/// Methods to compute exp. `fast` is the default. The others are from the paper, with its misprints
/// corrected; improved_sd is also guarded against equal eigenvalues.
/// For all methods except improved_sd_faithful, a NaN or an infinity in S gives six NaN, and the zero matrix
/// gives exactly the identity matrix I.
enum class Method {
  /// Full diagonalisation by QR (Eigen's SelfAdjointEigenSolver::compute). The error is at most
  /// (20 + 20 r) u, where r is the largest absolute eigenvalue. If an exponential overflows, the result has
  /// infinities and NaN.
  diag,

  /// The spectral decomposition of the paper: x I + y S + z S^2 with eigenvalues by QR. Eigenvalues that
  /// differ by less than 1e-6 count as equal. The number of distinct eigenvalues selects one of three
  /// formulas. If eigenvalues are close, x, y and z lose digits. The error is about 1e3 u on the paper's
  /// ensemble, and up to 4e-3 in double for three eigenvalues 1e-6 apart. In float the error has no limit,
  /// because 1e-6 is the size of rounding errors. If a term of x, y or z overflows, the result has infinities
  /// and NaN.
  sd,

  /// Like sd, but with Viete's closed form of the eigenvalues. The argument of the arc cosine is clamped to
  /// [-1, 1], and triple eigenvalues are a separate case. Rounding errors of the closed form can make this
  /// method less accurate than sd. If S is finite and no term overflows, the result has no NaN.
  improved_sd,

  /// Like improved_sd, without clamping and without a case for triple eigenvalues: the paper's algorithm with
  /// nothing but its misprints corrected. Only for comparison. The formula gives NaN for multiples of the
  /// identity, for half of all
  /// matrices with a double eigenvalue, and for some matrices with close eigenvalues.
  improved_sd_faithful,

  /// Shifts by the mean eigenvalue, then computes a recurrence in two invariants (exp-inl.h). For any trace
  /// and any gaps between eigenvalues, the error is at most (6 + 2 spread) u with fused multiply-add, and
  /// (8 + 2.5 spread) u without. With fused multiply-add, the error is at most 6 u for a spread up to 3, and
  /// 8 u on the paper's ensemble. Small entries are accurate only relative to the norm of the result.
  /// Exception: if S is diagonal with a spread above 6 (float 8), each entry is accurate relative to itself.
  /// Finite input never gives NaN. An entry that overflows becomes a signed infinity and leaves other entries
  /// unchanged: diag(710, 0, 0) gives diag(inf, 1, 1). Underflow is gradual.
  fast,
};

/// Name and description of a method.
struct MethodEntry {
  Method method;
  const char* name;      ///< stable, for command lines and files: "improved_sd"
  const char* label;     ///< display name: "Improved SD"
  const char* sentence;  ///< how the method works
};

/// All methods, in the order of the enumeration.
std::span<const MethodEntry> methods();
std::string_view name(Method method);
std::string_view label(Method method);
std::optional<Method> method_from_name(std::string_view name);

/// Returns exp(S); T is float or double.
template <class T>
Sym3<T> exp(const Sym3<T>& s, Method method = Method::fast);

/// Computes exp of many matrices, with the same bits as single calls. The sizes of `in` and `out` must be
/// equal. `in` and `out` must either be equal or not overlap.
template <class T>
void exp(std::span<const Sym3<T>> in, std::span<Sym3<T>> out, Method method = Method::fast);

/// Computes exp of `count` matrices by method `fast`. All layouts are allowed; equal layouts are faster. `in`
/// and `out` must either be equal or not overlap. Each result has the same bits as a single call with the
/// same kernel, for any number of threads.
void exp(const SymView<const double>& in, const SymView<double>& out, std::size_t count,
         const Batch& batch = {});
void exp(const SymView<const float>& in, const SymView<float>& out, std::size_t count,
         const Batch& batch = {});

/// Returns exp(S), computed by a Taylor polynomial and squarings in double-double, in about 2 us. The
/// relative error in the Frobenius norm is below 1e-28 for spreads up to 1000 (tested against 113 bits).
/// Results below 1e-270 are less accurate, because the low parts underflow. NaN or entries above 1e6 in size
/// give NaN. If the result overflows, it has infinities. Thread-safe.
Sym3<DoubleDouble> exp_reference(const Sym3<double>& s);

/// Returns |computed - exp(S)| / |exp(S)| in Frobenius norms, with exp_reference(). Returns NaN if a matrix
/// has a NaN or if exp(S) is outside the range of double.
double relative_error(const Sym3<double>& computed, const Sym3<double>& s);

/// The case that a method chooses for a matrix. Only for display: no computation uses Route. Fields that a
/// method does not use are 0.
struct Route {
  /// SD and improved SD: the number of distinct eigenvalues, 1 to 3, by the paper's threshold. For 1, 2 or 3,
  /// exp is a constant, linear or quadratic polynomial of the matrix (paper, section 2.2).
  int distinct = 0;
  int degree = 0;     ///< `fast`: degree of the polynomial
  int squarings = 0;  ///< `fast`: how often the matrix is halved and the result squared
  /// True if `fast` uses Jacobi's method: for diagonal matrices with a large spread, too many squarings,
  /// results that overflow, and input that is not finite.
  bool by_jacobi = false;

  friend bool operator==(const Route&, const Route&) = default;
};

/// Returns the choice in double. Close to a limit, the kernels may choose differently. Thread-safe.
Route route(const Sym3<double>& s, Method method);

}  // namespace viete::sym3
