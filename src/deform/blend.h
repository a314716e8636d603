// Link 3 of the frame: per vertex, the weighted sums of the handles' rows.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "deform/binding.h"
#include "deform/cage_state.h"
#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::deform {

/// Sums of rows of RowForm::logs, one entry per model vertex.
struct BlendedLogs {
  std::vector<sym3::Sym3<double>> stretch;
  std::vector<Vec3> rotation;
  std::vector<Vec3> center;  ///< relative to the pose's origin

  void resize(std::size_t n) { stretch.resize(n), rotation.resize(n), center.resize(n); }
};

/// Vertices [begin, end) of sums = weights * rows. Logs go to where exp takes them from; of any form sums are
/// [vertex][column]. They are sized already. Each sum runs over the handles in their order: the same bits for
/// any division into ranges.
void blend(const Binding& binding, const Rows& rows, std::size_t begin, std::size_t end, BlendedLogs& sums);
void blend(const Binding& binding, const Rows& rows, std::size_t begin, std::size_t end,
           std::span<double> sums);

}  // namespace viete::deform
