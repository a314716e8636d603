// From weights and rows to positions, in double.
#pragma once

#include <span>

#include "deform/binding.h"
#include "deform/cage_state.h"
#include "sym3/exp.h"

namespace viete::deform {

/// The staged links from the blend on, for all vertices of a binding: positions.size() of them. Returns how
/// far the method's exponentials are from those of method `fast`, which is exact to 1e-15: the largest
/// relative difference, Frobenius norm; infinity where one is not a number, 0 for `fast` and where there are
/// no exponentials.
double place_vertices(const Binding& binding, const Rows& rows, sym3::Method method,
                      std::span<mesh::Point> positions);

}  // namespace viete::deform
