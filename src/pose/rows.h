// A pose as rows of numbers, one row per handle, and the vertices of a frame. Vector code includes this file,
// so it has no functions (see sym3/fallback.h).
#pragma once

#include <cstddef>

#include "base/drawn_vertex.h"

namespace viete::pose {

/// The contents of a row, and the formula by which weighted sums of rows become a position. x is the vertex
/// at rest, relative to the middle of the rest cage. o = x - sum w * c is the vertex's offset from the
/// weighted mean of the handles' rest centres c. Posed positions are relative to the pose's origin.
enum class RowForm {
  logs,             ///< X = log S (xx xy xz yy yz zz), Y = log R, centre c':  exp(Y) * exp(X) * o + c'
  maps,             ///< D = M - I by rows, d = c' - c - D * c:               x + D * x + d
  positions,        ///< position p':                                          o + p'
  affine_moments,   ///< p / l, l * A by rows, p':                             M * o + sum w * p' (moments.h)
  similar_moments,  ///< as affine_moments, but M is a rotation and a scale
  rigid_moments,    ///< as affine_moments, but M is a rotation
};
struct RowShape {
  std::size_t columns;
  std::size_t first_length;  ///< index of the first column with lengths; earlier columns have no unit
  /// Number of leading columns from which the fused engine subtracts the mean of all rows. It adds the mean
  /// again after the blend. This reduces errors of compressed weights, which do not sum to exactly 1.
  std::size_t with_mean;
  /// Index of the first of three columns with the handles' centres; `columns` if there are none. See Shares.
  std::size_t center;
};

inline constexpr RowShape log_shape{12, 9, 9, 9};  // with_mean is 9: offsets correct the errors of centres
inline constexpr RowShape map_shape{12, 9, 12, 12};
inline constexpr RowShape position_shape{3, 0, 0, 0};
inline constexpr RowShape moment_shape{15, 3, 0, 12};
inline constexpr std::size_t most_columns = 15;
inline constexpr std::size_t row_forms = 6;

using FrameVertex = base::DrawnVertex;

}  // namespace viete::pose
