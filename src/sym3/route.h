// What a method decides by a matrix before it computes the exponential. For people to look at: nothing here
// is part of a computation.
#pragma once

#include "sym3/exp.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

/// 0 where the method has no such thing.
struct Route {
  /// Of SD and improved SD: how many eigenvalues they tell apart by the paper's threshold, 1 to 3. The form
  /// of exp is constant, linear or quadratic in the matrix accordingly (section 2.2 of the paper).
  int distinct = 0;
  int degree = 0;     ///< of `fast`: of the polynomial
  int squarings = 0;  ///< of `fast`: how often the matrix is halved before it, and squared behind it
  /// `fast` leaves it to Jacobi's method: diagonal matrices of a large spread, too many squarings, results
  /// that overflow, and what is not finite.
  bool by_jacobi = false;

  friend bool operator==(const Route&, const Route&) = default;
};

/// In double. Within rounding of a limit it may say the neighbour of what the vector code does. Thread-safe.
Route route(const Sym3<double>& s, Method method);

}  // namespace viete::sym3
