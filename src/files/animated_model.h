// The model deformed at frames of a timeline: bound once, then evaluated frame by frame.
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
#include "document/animation.h"
#include "files/export.h"

namespace viete::files {

/// Not thread-safe.
class AnimatedModel {
public:
  /// Double precision, or the window's float engine with unchanged weights.
  enum class Precision { exact, fast };

  /// Ignores model.pose. Replaces the precision `fast` by `exact` if the method or stitching does not support
  /// it, its weights need more than half of the free memory, or its error exceeds `most` (in diagonals of the
  /// cage) at one of the frames `tried`. model and pool must outlive this object; timeline must have keys.
  /// progress may be null. Throws base::Error and base::Cancelled.
  AnimatedModel(const Export& model, const document::Timeline& timeline, Precision wish, double most,
                std::span<const double> tried, base::WorkerPool& pool, base::Progress* progress = nullptr);

  Precision precision() const { return deformer_ ? Precision::fast : Precision::exact; }
  /// Estimated error of Precision::fast against double, in diagonals of the cage, including the rounding in
  /// floats(). Measured on error_sample vertices of all frames so far, times a factor for unmeasured ones.
  double fast_error() const;

  /// The complete pose at that frame.
  document::WholePose pose(double frame) const;
  /// The model's probes in that pose; locked probes stay.
  deform::Probes probes(const document::WholePose& pose) const;

  /// Equals deform_exactly() bit for bit. progress may be null.
  deform::ExactModel exact(const document::WholePose& pose, base::Progress* progress = nullptr);
  /// x, y, z of every vertex, by the engine of precision(); valid until the next call.
  std::span<const float> floats(double frame);
  std::vector<mesh::Point> positions(double frame);
  /// Messages about the last frame for the user, one line each.
  const std::vector<std::string>& notes() const { return notes_; }

private:
  bool has_cage() const;
  bool can_fuse() const;
  void take_notes(const deform::LogReport& report, const document::WholePose& pose,
                  const std::vector<std::string>& warnings);
  void make_fast(double most, std::span<const double> tried, base::Progress* progress);
  void run_fast(double frame);

  const Export& model_;
  base::WorkerPool& pool_;
  document::VectorCache vectors_;
  std::optional<document::Animation> animation_;
  std::unique_ptr<deform::Deformer> deformer_;    // null: exact
  std::unique_ptr<deform::ExactDeformer> exact_;  // created on first use
  double error_ = 0;                              // the largest measured
  double farthest_ = 0;                           // largest coordinate rounded to float
  std::vector<float> floats_;
  std::vector<std::string> notes_;
};

}  // namespace viete::files
