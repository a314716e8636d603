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
  stretches,        ///< S - I (xx xy xz yy yz zz), Y, c':                     exp(Y) S o + c'
  quaternions,      ///< S - I, the quaternion of exp(Y) (w - 1, x, y, z), c': R(q / |q|) S o + c'
  matrix_logs,      ///< L = log M by rows, c':                                exp(L) o + c'
  screws,           ///< X, Y, E - I (xx xy xz yy yz zz), a, c':               exp(X) o, then exp of (Y, u)
  affine_logs,      ///< L, E - I by rows, a, c':                              exp of (L, u)
  affine_moments,   ///< p / l, l A by rows, p', see moments.h:            M o + p'*, M fitted
  similar_moments,  ///< the same, M a rotation and a scale
  rigid_moments,    ///< the same, M a rotation
};
// Of the last two: what takes p to exp(L) p + phi(L) u + c', u = a - E (c' - m) + L (c' + m) / 2 with m = x -
// o; of screws L p = Y x p. See sym3/translation_log.h.

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
inline constexpr RowShape stretch_shape{12, 9, 9, 9};
inline constexpr RowShape quaternion_shape{13, 10, 10, 10};
inline constexpr RowShape matrix_log_shape{12, 9, 9, 9};
inline constexpr RowShape screw_shape{21, 15, 15, 18};
inline constexpr RowShape affine_log_shape{24, 18, 18, 21};
inline constexpr RowShape moment_shape{15, 3, 0, 12};
inline constexpr std::size_t most_columns = 24;
inline constexpr std::size_t row_forms = 11;

}  // namespace viete::deform
