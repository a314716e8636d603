// A motion as poses that a model takes one after another with straight lines between them, as many as keep
// the lines near the motion.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "base/progress.h"
#include "mesh/surface.h"

namespace viete::scene {

/// Where all vertices are at a frame.
using MotionAt = std::function<std::vector<mesh::Point>(double frame)>;

struct MotionSample {
  double frame = 0;
  std::vector<mesh::Point> positions;
};
struct MotionSamples {
  std::vector<MotionSample> samples;  ///< by frame
  double error = 0;  ///< the largest distance of a vertex from its line, measured at a quarter, half and
                     ///< three quarters of each; in the file's unit
};

/// Frames of a smooth motion between which it takes a jump (from `hold` to the next key) lie so near.
inline constexpr double jump_frames = 1e-3;

/// Samples at `frames`, which ascend, and between them as many as are needed for an error of at most
/// `tolerance`, above 0. What is between two of `frames` that lie no farther apart than jump_frames is not
/// looked at. Throws base::Error where they do not fit into memory, and base::Cancelled.
MotionSamples sample_motion(const std::vector<double>& frames, const MotionAt& at, double tolerance,
                            base::Progress* progress = nullptr);

/// At these frames alone; error says what that is good for.
MotionSamples sample_at(const std::vector<double>& frames, const MotionAt& at,
                        base::Progress* progress = nullptr);

}  // namespace viete::scene
