// viete bench frame, bind and splats: times of all ways to compute a frame, and to bind a model.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/models.h"
#include "bench/table.h"
#include "deform/frame_deformer.h"

namespace viete::bench {

/// The times of one way to compute a frame, on one thread or on all threads.
struct FrameTime {
  std::size_t vertices, faces;
  std::string name;  ///< see frame_names
  int threads;
  double cpu_ms, wall_ms;   ///< medians; cpu_ms is the time of the slowest thread
  double error;             ///< largest distance from the staged vertices, in cage diagonals; NaN if unknown
  std::size_t bytes;        ///< number of bytes that one frame reads
  pose::StageTimes stages;  ///< medians of wall time
};

namespace frame_names {
inline constexpr const char* reference = "reference";
inline constexpr const char* staged_fast = "staged, fast";
inline constexpr const char* dense = "fused, dense";
inline constexpr const char* compressed = "fused, compressed";
inline constexpr const char* dragged = "one vertex dragged";
}  // namespace frame_names

/// Measures the model in the cage. If options.cage is empty, measures one generated cage for each number of
/// faces. Each round runs every frame once. Throws base::Error and base::Cancelled.
std::vector<FrameTime> measure_frames(const ModelOptions& options, base::Progress& progress);
nlohmann::json to_json(std::span<const FrameTime> times);

/// Returns the time with this name, on one thread or on all threads. If it is missing, returns null.
const FrameTime* frame_of(std::span<const FrameTime> times, const std::string& name, std::size_t faces,
                          bool threaded = false);

/// Checks the limits for generated cages.
void check_frame(std::span<const FrameTime> times, Bars& bars);

/// Measure and print tables. Throw base::Error.
void bench_frame(const ModelOptions& options);
void bench_bind(const ModelOptions& options);
/// `options.count`: number of splats, at least 1.
void bench_splats(const ModelOptions& options);

}  // namespace viete::bench
