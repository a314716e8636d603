// The branch that a method takes for a matrix. For display only: no computation uses it.
#pragma once

#include "sym3/exp.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

/// Fields are 0 if the method does not have them.
struct Route {
  /// SD and improved SD: number of eigenvalues that the paper's threshold separates, 1 to 3. The form of exp
  /// is constant, linear or quadratic in the matrix accordingly (section 2.2 of the paper).
  int distinct = 0;
  int degree = 0;     ///< `fast`: degree of the polynomial
  int squarings = 0;  ///< `fast`: number of halvings before it, and of squarings after it
  /// `fast` uses Jacobi's method: for diagonal matrices of a large spread, too many squarings, results that
  /// overflow, and input that is not finite.
  bool by_jacobi = false;

  friend bool operator==(const Route&, const Route&) = default;
};

/// In double. Within rounding of a limit it may differ from the vector code. Thread-safe.
Route route(const Sym3<double>& s, Method method);

}  // namespace viete::sym3
