// viete bench frame: every path of the frame, timed and compared.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/table.h"
#include "deform/deformer.h"
#include "deform/scheme.h"
#include "deform/tiled_binding.h"

namespace viete::bench {

/// One measurement at one size: a path, on one thread or all, or a lower bound.
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
inline constexpr const char* exponential = "exponentials alone";
inline constexpr const char* read_floor = "floor: reading";
inline constexpr const char* multiply_add_floor = "floor: multiply-adds";
}  // namespace frame_names

/// Checks the limits that these times cover. Sizes are the smallest number of vertices and the largest.
void check_frame(std::span<const FrameTime> times, Bars& bars);

struct FrameOptions {
  std::filesystem::path model;
  std::filesystem::path cage;             ///< empty: cages of `faces` triangles are generated for the model
  std::vector<std::size_t> counts = {0};  ///< vertices: the model is truncated or subdivided; 0: unchanged
  std::vector<std::size_t> faces = {50, 100, 300, 600};
  std::size_t rounds = 11;
  double tolerance = deform::usual_tolerance;
  std::filesystem::path json;  ///< output of the numbers; empty: none
};

/// Measures each number of vertices in each cage, all paths interleaved. Throws base::Error, base::Cancelled.
std::vector<FrameTime> measure_frames(const FrameOptions& options, base::Progress& progress);
nlohmann::json to_json(std::span<const FrameTime> times);

/// Prints the tables. Throws base::Error.
void bench_frame(const FrameOptions& options);

}  // namespace viete::bench
