// What the frame promises, checked against what was measured of it.
#pragma once

#include <array>
#include <span>
#include <string>

#include "bench/table.h"
#include "deform/deformer.h"

namespace viete::bench {

/// One thing that was measured at one size: a path, on one thread or all, or a floor.
struct FrameTime {
  std::size_t vertices, faces;
  std::string name;  ///< as below
  int threads;
  double cpu_ms, wall_ms;  ///< medians; processor time of the slower thread
  double error;       ///< largest distance from the staged frame by QR in diagonals of the cage; NaN: none
  std::size_t bytes;  ///< read once a frame
  deform::LinkTimes links;  ///< medians, wall
};

namespace frame_names {
inline constexpr const char* reference = "reference";
inline constexpr const char* staged_fast = "staged, fast";
inline constexpr const char* dense = "fused, dense";
inline constexpr const char* compressed = "fused, compressed";
inline constexpr const char* dragged = "one vertex dragged";
inline constexpr const char* exponential = "exponentials alone";
inline constexpr const char* read_floor = "floor: reading";
inline constexpr const char* multiply_add_floor = "floor: multiply-adds";
}  // namespace frame_names

/// Those bars that these times say anything about. Sizes are the smallest number of vertices and the largest.
void check_frame(std::span<const FrameTime> times, Bars& bars);

}  // namespace viete::bench
