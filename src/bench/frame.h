// viete bench frame: what a frame costs, by path, size and stage.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "base/progress.h"
#include "bench/frame_bars.h"
#include "deform/scheme.h"
#include "deform/tiled_binding.h"

namespace viete::bench {

struct FrameOptions {
  std::filesystem::path model;
  std::filesystem::path cage;             ///< empty: cages of `faces` triangles are made for the model
  std::vector<std::size_t> counts = {0};  ///< vertices: the model is cut off or subdivided; 0: as it is
  std::vector<std::size_t> faces = {50, 100, 300, 600};
  std::size_t rounds = 11;
  double tolerance = deform::usual_tolerance;
  std::filesystem::path json;  ///< the numbers go here too; empty: nowhere
};

/// Each number of vertices in each cage, all paths interleaved. Throws base::Error, base::Cancelled.
std::vector<FrameTime> measure_frames(const FrameOptions& options, base::Progress& progress);
nlohmann::json to_json(std::span<const FrameTime> times);

/// Prints the tables. Throws base::Error.
void bench_frame(const FrameOptions& options);

}  // namespace viete::bench
