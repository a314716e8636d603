// The rows of one handle, of each form, from its map and the logs of that.
#pragma once

#include <span>

#include "deform/affine_map.h"
#include "deform/cage.h"
#include "deform/log_maps.h"
#include "deform/rows.h"

namespace viete::deform {

/// True if maps are fitted to points: see moments.h.
bool has_moments(RowForm form);

/// Rows of RowForm::maps and RowForm::logs; rest_center is relative to the middle of the rest cage. For the
/// identity every entry but the centre is exactly 0.
void write_map_row(const AffineMap& map, const Vec3& rest_center, std::span<double> row);
void write_log_row(const MapLog& log, std::span<double> row);

/// l of moments.h: 10 % of the root mean square of the rest cage's edges. Positive.
double moment_length(const Cage& cage);
/// p / l (from the middle of the rest cage), l A by rows and p' (from the pose's origin). map: of the point's
/// patch; rest_center: p, from the middle of the rest cage.
void write_moment_row(const AffineMap& map, const Vec3& rest_center, double length, std::span<double> row);

}  // namespace viete::deform
