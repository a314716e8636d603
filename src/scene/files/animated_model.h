// The model at the moments of a timeline: bound once, then frame after frame.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/deformer.h"
#include "deform/exact.h"
#include "scene/document/animation.h"
#include "scene/files/export.h"

namespace viete::scene {

/// Not thread-safe.
class AnimatedModel {
public:
  /// In double, or in float by the engine that the window uses, with weights that are left as they are.
  enum class Precision { exact, fast };

  /// model.pose is not looked at. `fast` is what is wished for: where the method or a stitched model does not
  /// go by it, its weights take more than half of the memory that is free, or it would be off by more than
  /// `most` (diagonals of the cage) at one of `tried` frames, it is exact. model and pool must outlive it;
  /// timeline must have keys. progress may be null. Throws base::Error and base::Cancelled.
  AnimatedModel(const Export& model, const Timeline& timeline, Precision wish, double most,
                std::span<const double> tried, base::WorkerPool& pool, base::Progress* progress = nullptr);

  Precision precision() const { return deformer_ ? Precision::fast : Precision::exact; }
  /// Of Precision::fast, in diagonals of the cage: how far from double frames may be, floats() with what
  /// their rounding adds. By error_sample vertices of all frames so far, times what others may have more.
  double fast_error() const;

  /// What moves the model at that frame.
  WholePose pose(double frame) const;
  /// The model's probes in that pose: those that are locked stay.
  deform::Probes probes(const WholePose& pose) const;

  /// The same bits as deform_exactly(). progress may be null.
  deform::ExactModel exact(const WholePose& pose, base::Progress* progress = nullptr);
  /// x, y, z of every vertex as its precision has them; until the next call.
  std::span<const float> floats(double frame);
  std::vector<mesh::Point> positions(double frame);
  /// What a person should know of the last frame, one line each.
  const std::vector<std::string>& notes() const { return notes_; }

private:
  bool has_cage() const;
  bool fuses() const;
  bool has_memory_to_fuse() const;
  void make_fast(double most, std::span<const double> tried, base::Progress* progress);
  void run_fast(double frame);

  const Export& model_;
  base::WorkerPool& pool_;
  KnownVectors vectors_;
  std::optional<Animation> animation_;
  std::unique_ptr<deform::Deformer> deformer_;    // null: exact
  std::unique_ptr<deform::ExactDeformer> exact_;  // null until it is asked for
  double error_ = 0;                              // the largest measured
  double farthest_ = 0;                           // coordinate that was rounded to a float
  std::vector<float> floats_;
  std::vector<std::string> notes_;
};

}  // namespace viete::scene
