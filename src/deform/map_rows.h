// The rows of one handle, of each form, from its map and the logs of that.
#pragma once

#include <span>

#include "deform/affine_map.h"
#include "deform/log_maps.h"
#include "deform/rows.h"

namespace viete::deform {

/// True if rows of this form are made of logs, so that rotations have branches.
bool has_logs(RowForm form);

/// True if the first six columns are logs of stretches, which an exponential is taken of.
bool has_stretch_logs(RowForm form);

/// True if maps are fitted to points: see moments.h.
bool has_moments(RowForm form);

/// log is of use where the form has logs; rest_center relative to the middle of the rest cage. Of a map that
/// does nothing all but the centre is exactly 0. row.size() == columns of the form, which is neither
/// positions nor moments.
void write_row(RowForm form, const AffineMap& map, const MapLog& log, const Vec3& rest_center,
               std::span<double> row);

}  // namespace viete::deform
