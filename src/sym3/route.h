// The case that a method chooses for a matrix. Only for display: no computation uses Route.
#pragma once

#include "sym3/exp.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

/// Fields that a method does not use are 0.
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
