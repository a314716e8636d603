// Link 3 of the frame: per vertex, the weighted sums of the elements' logs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "deform/binding.h"
#include "deform/log_maps.h"

namespace viete::deform {

/// One entry per model vertex.
struct BlendedLogs {
  std::vector<sym3::Sym3<double>> stretch;
  std::vector<Vec3> rotation;
  std::vector<Vec3> center;  ///< relative to the pose's origin
};

/// Vertices [begin, end) of sums = weights * logs. sums is sized already. Each sum runs over the handles in
/// their order: the same bits for any division into ranges.
void blend(const Binding& binding, std::span<const MapLog> logs, std::size_t begin, std::size_t end,
           BlendedLogs& sums);

/// The same for plain positions (mean value coordinates): out = origin + (weights * posed + offsets), posed
/// relative to origin. posed.size() == binding.handles.
void blend_positions(const Binding& binding, std::span<const Vec3> posed, const Vec3& origin,
                     std::size_t begin, std::size_t end, std::span<mesh::Point> out);

}  // namespace viete::deform
