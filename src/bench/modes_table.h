// The results of all schemes, as tables and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "bench/modes.h"

namespace viete::bench {

/// Explains the columns.
inline constexpr const char* modes_legend =
    R"(  moved, rigid, similar, affine: deviation of the model from the map of this kind that poses the whole
    cage, in diagonals; exact: below 1e-9
  leak: motion of vertices more than a quarter of the diagonal away when one vertex of the cage moves
    by a tenth of it, in diagonals; median over the model, and over 8 vertices of the cage
  frame, bind: ms, processor time of one thread; *: stage by stage, in double
  volume: relative to rest
  energy: symmetric Dirichlet energy of the triangles, 0 at rest, mean by area; x mvc: relative to mean
    value coordinates
  bending: energy of the changes of angle between triangles (discrete shells); kinks increase it
  gap: mean distance of the surface from the posed nearest point of the cage, in diagonals
)";

/// Over the poses with a number; NaN if there are none.
struct OverPoses {
  double least, middle, most;
};
OverPoses over_poses(const Mode& mode, double ShapeQuality::*value);

/// One table of the schemes, one per pose, and a summary if there are several poses.
void print(const ModeComparison& compared, std::span<const NamedPose> poses);
nlohmann::json to_json(const ModeComparison& compared, std::span<const NamedPose> poses);

}  // namespace viete::bench
