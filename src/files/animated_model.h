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

/// Not thread-safe.
class AnimatedModel {
public:
  /// exact: double precision. fast: the float engine of the window, with uncompressed weights.
  enum class Precision { exact, fast };

  /// Ignores model.pose. Uses `exact` instead of `fast` if the method or stitching does not support `fast`,
  /// if its weights need more than half of the free memory, or if its error at a frame in `tried` exceeds
  /// `most` diagonals of the cage. model and pool must outlive this object; timeline must have keys. progress
  /// may be null. Throws base::Error and base::Cancelled.
  AnimatedModel(const Export& model, const document::Timeline& timeline, Precision wish, double most,
                std::span<const double> tried, base::WorkerPool& pool, base::Progress* progress = nullptr);

  Precision precision() const { return deformer_ ? Precision::fast : Precision::exact; }
  /// Estimated error of Precision::fast in diagonals of the cage, including the rounding in floats(). It is
  /// the largest error of error_sample vertices at all frames so far, times a factor for the other vertices.
  double fast_error() const;

  document::WholePose pose(double frame) const;
  /// The model's probes in this pose; locked probes stay.
  deform::Probes probes(const document::WholePose& pose) const;

  /// Returns the same bits as deform_exactly(). progress may be null.
  deform::ExactModel exact(const document::WholePose& pose, base::Progress* progress = nullptr);
  /// x, y, z of every vertex in the precision of this object; valid until the next call.
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
  std::unique_ptr<deform::ExactDeformer> exact_;  // created on first use
  double error_ = 0;                              // the largest measured error
  double farthest_ = 0;                           // the largest coordinate that floats() returned
  std::vector<float> floats_;
  std::vector<std::string> notes_;
};

}  // namespace viete::files
