#include "deform/place_vertices.h"

#include <vector>

#include "deform/apply.h"
#include "deform/blend.h"
#include "deform/map_rows.h"
#include "deform/moments.h"

namespace viete::deform {

double place_vertices(const Binding& binding, const Rows& rows, sym3::Method method,
                      std::span<mesh::Point> positions) {
  const std::size_t n = positions.size();
  if (has_moments(rows.form)) {
    place_by_moments(binding, binding.shares, rows, {}, 0, n, positions);
    return 0;
  }
  std::vector<double> sums(n * rows.columns());
  blend(binding, rows, 0, n, sums);
  share_sums(binding, binding.shares, rows.form, 0, n, sums);
  return place_sums(binding, rows.form, sums, rows.origin, method, positions, true);
}

}  // namespace viete::deform
