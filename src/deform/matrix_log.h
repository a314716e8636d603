// Logarithms and exponentials of general 3x3 matrices: of a turn and a stretch in one.
#pragma once

#include "deform/log_maps.h"
#include "sym3/rotation.h"

namespace viete::deform {

/// L with exp(L) = linear = exp(Y) exp(X), log being X and Y: the logarithm whose turn is nearest to that of
/// Y, so that branches that are coherent over the cage stay so. Exactly 0 where X and Y are.
///
/// Some matrices have no real logarithm, those that turn by about 180 degrees and stretch across: on the way
/// there logarithms grow without bounds. So L leaves log M for X + Y, which is the same where stretch and
/// turn commute, as |L| goes from twice to four times |X| + |Y| (Frobenius norms): it is continuous, and
/// bounded. The same where a turn of more than 180 degrees leaves no plane of rotation to tell it by.
sym3::Mat3<double> matrix_log(const sym3::Mat3<double>& linear, const MapLog& log);

/// exp of a general matrix, to 1e-14 of its norm up to |L| = 20.
sym3::Mat3<double> matrix_exp(const sym3::Mat3<double>& log);

}  // namespace viete::deform
