// viete bench frame and bind: every path of the frame, and of binding, timed and compared.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/models.h"
#include "bench/table.h"
#include "deform/deformer.h"

namespace viete::bench {

/// One measurement: a path, on one thread or all.
struct FrameTime {
  std::size_t vertices, faces;
  std::string name;  ///< see below
  int threads;
  double cpu_ms, wall_ms;  ///< medians; processor time of the slower thread
  double error;  ///< largest distance from the staged frame by QR in diagonals of the cage; NaN: not measured
  std::size_t bytes;        ///< read once per frame
  deform::LinkTimes links;  ///< medians, wall
};

namespace frame_names {
inline constexpr const char* reference = "reference";
inline constexpr const char* staged_fast = "staged, fast";
inline constexpr const char* dense = "fused, dense";
inline constexpr const char* compressed = "fused, compressed";
inline constexpr const char* dragged = "one vertex dragged";
}  // namespace frame_names

/// Measures the model in its cage or, without one, in a generated cage for each number of faces; all paths
/// interleaved. Throws base::Error, base::Cancelled.
std::vector<FrameTime> measure_frames(const ModelOptions& options, base::Progress& progress);
nlohmann::json to_json(std::span<const FrameTime> times);

/// The single-threaded time of this name; null if there is none.
const FrameTime* frame_of(std::span<const FrameTime> times, const std::string& name, std::size_t faces,
                          bool threaded = false);

/// Checks the limits for generated cages.
void check_frame(std::span<const FrameTime> times, Bars& bars);

/// Print the tables. Throw base::Error.
void bench_frame(const ModelOptions& options);
void bench_bind(const ModelOptions& options);

}  // namespace viete::bench
