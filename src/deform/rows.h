// A pose as numbers that are summed: a row a handle. Shared with vector code: no functions here (see
// sym3/fallback.h).
#pragma once

#include <cstddef>

namespace viete::deform {

/// What a row holds, and so how sums of rows become positions. x is the vertex at rest relative to the middle
/// of the rest cage, o = x - sum w c its offset from the weighted mean of the handles' rest centres, and
/// positions are relative to the pose's origin.
enum class RowForm {
  logs,             ///< X = log S (xx xy xz yy yz zz), Y = log R, centre c':  exp(Y) exp(X) o + c'
  maps,             ///< D = M - I by rows, d = D (-c) + c' - c:               x + D x + d
  positions,        ///< position p':                                          o + p'
  affine_moments,   ///< p / l, l A by rows, p', see moments.h:            M o + p'*, M fitted
  similar_moments,  ///< the same, M a rotation and a scale
  rigid_moments,    ///< the same, M a rotation
};
struct RowShape {
  std::size_t columns;
  std::size_t first_length;  ///< columns from here on are lengths, those before have no unit
  /// Weights sum to one up to what compression leaves out, so what all rows share is best not weighted at
  /// all: of so many columns, the first ones, the mean is left out of the sums and added to them.
  std::size_t with_mean;
  /// Of the three columns that hold where the handles' centres are; `columns` where none do. See Shares in
  /// binding.h.
  std::size_t center;
};

inline constexpr RowShape log_shape{12, 9, 9, 9};  // what the centres miss, the offsets hold
inline constexpr RowShape map_shape{12, 9, 12, 12};
inline constexpr RowShape position_shape{3, 0, 0, 0};
inline constexpr RowShape moment_shape{15, 3, 0, 12};
inline constexpr std::size_t most_columns = 15;
inline constexpr std::size_t row_forms = 6;

}  // namespace viete::deform
