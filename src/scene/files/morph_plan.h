// A motion as few poses of a model, which are added to it with weights in time: what morph targets need.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/surface.h"

namespace viete::scene {

/// Where all vertices are at a frame.
using MotionAt = std::function<std::vector<mesh::Point>(double frame)>;

/// What a person asks of it.
struct MorphWish {
  double tolerance = 0;         ///< how far vertices may be from the motion, in the file's unit; above 0
  bool refines = true;          ///< puts moments between the given ones, so that it holds between them too
  double bytes_of_vertex = 12;  ///< that each target takes in the file
  double most_bytes = 1e9;      ///< of all targets and weights
  std::string to_allow_more{};  ///< see AnimationExport
};

/// At each moment the differences of targets from rest are added, each times its weight; between moments
/// weights go straight. Weights are 0 to 1, for there are programs that take no others: what else they would
/// need is in the targets, and in one more whose weight is always 1.
struct MorphPlan {
  std::vector<double> frames;  ///< the moments, ascending
  std::vector<float> weights;  ///< of each moment as many as there are targets
  struct Share {
    double frame;  ///< the difference of its pose from rest,
    double times;
  };
  using Target = std::vector<Share>;  ///< what it adds to rest
  std::vector<Target> targets;        ///< those first that add most
  bool steady = false;                ///< the last one's weight is always 1: it shows no frame
  std::vector<char> moves;            ///< vertices that do not stay at rest
  double error = 0;     ///< the largest distance from the motion that was measured, with what floats
                        ///< do to it
  double farthest = 0;  ///< coordinate

  double bytes(double bytes_of_vertex) const;
  /// Of target `t`, as the motion has it.
  std::vector<mesh::Point> positions(std::size_t t, std::span<const mesh::Point> rest,
                                     const MotionAt& at) const;
};

/// Frames of a smooth motion between which it takes a jump (from `hold` to the next key) lie so near.
inline constexpr double jump_frames = 1e-3;

/// Coordinates are told apart in files of floats by this share of their size, and no better.
inline constexpr double float_noise = 0x1p-22;

/// Moments at `frames`, which ascend, and between them as many as are needed. What is between two of `frames`
/// that lie no farther apart than jump_frames is not looked at. Of what lies far off, floats hold float_noise
/// of its coordinates, where that is more than the tolerance. Holds a few poses and the directions of the
/// targets. Throws base::Error where the motion needs more than is allowed, or than fits into memory, or a
/// position is none that floats hold; and base::Cancelled.
MorphPlan plan_morphs(std::span<const mesh::Point> rest, const std::vector<double>& frames,
                      const MotionAt& at, const MorphWish& wish, base::WorkerPool& pool,
                      base::Progress* progress = nullptr);

}  // namespace viete::scene
