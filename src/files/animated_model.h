// Binds a model once and deforms it at any frame of a timeline.
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

/// Computes the deformed model at any frame. Not thread-safe.
class AnimatedModel {
public:
  /// exact: double precision. fast: the float engine that the window uses, with uncompressed weights.
  enum class Precision { exact, fast };

  /// Ignores model.pose. If `fast` is requested, uses `exact` in three cases: the method or stitching does
  /// not support `fast`, the weights need more than half of the free memory, or the error at a frame in
  /// `tried` exceeds `most` diagonals of the cage. model and pool must outlive this object. timeline must
  /// have keys. progress may be null. Throws base::Error and base::Cancelled.
  AnimatedModel(const Export& model, const document::Timeline& timeline, Precision wish, double most,
                std::span<const double> tried, base::WorkerPool& pool, base::Progress* progress = nullptr);

  Precision precision() const { return deformer_ ? Precision::fast : Precision::exact; }
  /// Estimated error of Precision::fast in diagonals of the cage, including the rounding in floats(). It is
  /// the largest error of error_sample vertices at all frames so far, times a factor for the other vertices.
  double fast_error() const;

  document::WholePose pose(double frame) const;
  /// Returns the model's probes in this pose. Locked probes do not move.
  deform::Probes probes(const document::WholePose& pose) const;

  /// Returns the model with the same bits as deform_exactly(). progress may be null.
  deform::ExactModel exact(const document::WholePose& pose, base::Progress* progress = nullptr);
  /// Returns x, y, z of every vertex in the precision of this object. Valid until the next call.
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
  std::unique_ptr<deform::Deformer> deformer_;    // null for Precision::exact
  std::unique_ptr<deform::ExactDeformer> exact_;  // created when first needed
  double error_ = 0;                              // the largest error so far
  double farthest_ = 0;                           // the largest coordinate that floats() has returned
  std::vector<float> floats_;
  std::vector<std::string> notes_;
};

}  // namespace viete::files
