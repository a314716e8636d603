// Link 3 of the frame: per vertex, the weighted sums of the handles' rows.
#pragma once

#include <cstddef>
#include <span>

#include "deform/binding.h"
#include "deform/cage_state.h"

namespace viete::deform {

/// Vertices [begin, end) of sums = weights * rows, [vertex][column], sized already. Each sum runs over the
/// handles in their order: the same bits for any division into ranges.
void blend(const Binding& binding, const Rows& rows, std::size_t begin, std::size_t end,
           std::span<double> sums);

}  // namespace viete::deform
