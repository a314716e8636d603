// The methods of the paper for exp of one matrix, see Method in exp.h. Internal.
#pragma once

#include "sym3/sym3.h"

namespace viete::sym3 {

template <class T>
Sym3<T> exp_diag(const Sym3<T>& s);

template <class T>
Sym3<T> exp_sd(const Sym3<T>& s);

template <class T>
Sym3<T> exp_improved_sd(const Sym3<T>& s);

/// Returns NaN if the printed formula gives NaN.
template <class T>
Sym3<T> exp_improved_sd_faithful(const Sym3<T>& s);

/// Return the number of distinct eigenvalues, 1 to 3: eigenvalues closer than the paper's threshold count as
/// one. `s` must be finite.
int distinct_by_qr(const Sym3<double>& s);
int distinct_by_viete(const Sym3<double>& s, bool as_printed);

}  // namespace viete::sym3
