// Where a surface cuts through itself.
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// The triangles that another one crosses or, in the same plane, overlaps; ascending. Touching does not
/// count: neither neighbours at their common edge or vertex, whether they share it by number or by place, nor
/// parts that only meet. Triangles without area are left out. Exact: no tolerance. Any length scale from
/// 1e-100 to 1e100. A sweep along the longest axis of the box: O(n log n) and the pairs whose boxes overlap
/// there. progress may be null; throws base::Cancelled.
std::vector<std::uint32_t> self_intersecting_triangles(const Surface& surface,
                                                       base::Progress* progress = nullptr);

}  // namespace viete::mesh
