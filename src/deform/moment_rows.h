// Rows of moving least squares: see moments.h.
#pragma once

#include <span>

#include "deform/affine_map.h"
#include "deform/cage.h"

namespace viete::deform {

/// Rows hold p / l (from the middle of the rest cage), l A by rows and p' (from the pose's origin).

/// l: 10 % of the root mean square of the rest cage's edges. Positive.
double moment_length(const Cage& cage);

/// map: of the point's patch; rest_center: p, from the middle of the rest cage. row.size() == 15.
void write_moment_row(const AffineMap& map, const Vec3& rest_center, double length, std::span<double> row);

}  // namespace viete::deform
