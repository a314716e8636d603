// What someone asks for of a scheme, by words and numbers, and the scheme that it comes to.
#pragma once

#include <optional>

#include "deform/ways.h"

namespace viete::deform {

struct AskedScheme {
  std::optional<Way> way{};  ///< all of it; what is asked for besides is changed in it
  PartialChoice choice{};
  std::optional<double> radius{};           ///< of cut-off weights
  std::optional<double> turn{}, stretch{};  ///< of Amounts
  std::optional<int> iterations{};          ///< of stitching
  std::optional<double> pins{}, hold{};     ///< of Holding

  bool any() const { return way || choice.any() || radius || turn || stretch || iterations || pins || hold; }
};

/// Choices left open keep their present value where it is compatible with the others. Throws base::Error
/// if choices do not go together, or a radius of weights that have none, or amounts or stitching where
/// elements only move.
///
/// A radius chooses cut-off weights, unless someone has chosen others: by name here, or before (`chosen`), as
/// in a session.
Scheme scheme_of(const AskedScheme& asked, const Scheme& now, bool chosen = false);

}  // namespace viete::deform
