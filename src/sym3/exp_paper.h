// The paper's three methods for exp, one matrix at a time. Internal.
#pragma once

#include <array>

#include "sym3/sym3.h"

namespace viete::sym3 {

/// Number of eigenvalues that the paper's threshold of section 2.2 separates, 1 to 3. NaN counts as distinct.
template <class T>
int distinct_eigenvalues(const std::array<T, 3>& eigenvalues);

template <class T>
Sym3<T> exp_diag(const Sym3<T>& s);

template <class T>
Sym3<T> exp_sd(const Sym3<T>& s);

template <class T>
Sym3<T> exp_improved_sd(const Sym3<T>& s);

/// Unguarded: NaN whenever the printed formula gives NaN.
template <class T>
Sym3<T> exp_improved_sd_faithful(const Sym3<T>& s);

}  // namespace viete::sym3
