// The case that a method chooses for a matrix. For display only: no computation uses it.
#pragma once

#include "sym3/exp.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

/// Fields that a method does not use are 0.
struct Route {
  /// SD and improved SD: number of eigenvalues that differ by more than the paper's threshold, 1 to 3. exp is
  /// then a constant, linear or quadratic polynomial of the matrix (section 2.2 of the paper).
  int distinct = 0;
  int degree = 0;     ///< `fast`: degree of the polynomial
  int squarings = 0;  ///< `fast`: number of halvings of the matrix, and of squarings of the result
  /// `fast` uses Jacobi's method: for diagonal matrices with a large spread, too many squarings, results that
  /// overflow, and input that is not finite.
  bool by_jacobi = false;

  friend bool operator==(const Route&, const Route&) = default;
};

/// The choice in double. Close to a limit, rounding may make it differ from the kernels' choice. Thread-safe.
Route route(const Sym3<double>& s, Method method);

}  // namespace viete::sym3
