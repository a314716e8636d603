// Stages: the steps that compute a frame, and their times.
#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <string_view>

namespace viete::pose {

/// A step in the computation of a frame. `fused` combines blend, exp and apply in one pass. `skeleton` blends
/// pivots (see LeafFactors). `triangle_maps` and `solve` are the iterations of stitching. `splats` are
/// the derivatives at Gaussian splats.
enum class Stage {
  maps,
  log_maps,
  blend,
  exp,
  apply,
  skeleton,
  fused,
  triangle_maps,
  solve,
  probes,
  normals,
  splats
};
inline constexpr std::size_t stage_count = 12;

constexpr std::string_view name(Stage stage) {
  constexpr std::array<std::string_view, stage_count> names = {"maps",  "log maps", "blend",   "exp",
                                                               "apply", "skeleton", "fused",   "triangles",
                                                               "solve", "probes",   "normals", "splats"};
  return names[static_cast<std::size_t>(stage)];
}

/// Elapsed milliseconds of each stage in one frame; 0 for stages that the frame does not use.
struct StageTimes {
  std::array<double, stage_count> ms{};

  double& operator[](Stage stage) { return ms[static_cast<std::size_t>(stage)]; }
  double operator[](Stage stage) const { return ms[static_cast<std::size_t>(stage)]; }
  double total() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }
  StageTimes& operator+=(const StageTimes& other) {
    for (std::size_t i = 0; i < stage_count; ++i) ms[i] += other.ms[i];
    return *this;
  }
};

}  // namespace viete::pose
