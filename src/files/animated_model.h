// Binds a model once and deforms the model at any frame of a timeline.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/exact.h"
#include "deform/frame_deformer.h"
#include "document/animation.h"
#include "files/export.h"

namespace viete::files {

/// Not thread-safe.
class AnimatedModel {
public:
  enum class Precision {
    exact,  ///< double precision
    fast    ///< the float engine of the window, with uncompressed weights
  };

  /// `model` and `pool` must outlive this object. `timeline` must have keys. Ignores model.pose. Throws
  /// base::Error and base::Cancelled. If `wish` is `fast`, this object still uses `exact` in these cases:
  /// - There is no cage, or the method or stitching does not support `fast`.
  /// - The weights need more than half of the free memory.
  /// - The error of `fast` at the frames in `tried` exceeds `most` * diagonal of the cage.
  AnimatedModel(const Export& model, const document::Timeline& timeline, Precision wish, double most,
                std::span<const double> tried, base::WorkerPool& pool, base::Progress* progress = nullptr);

  Precision precision() const { return deformer_ ? Precision::fast : Precision::exact; }
  /// Estimates the ratio: error of Precision::fast / diagonal of the cage. The error is measured at some
  /// vertices, in all frames computed so far; a factor covers other vertices.
  double fast_error() const;

  /// The largest change of a coordinate by the rounding in floats() so far.
  double rounding() const { return rounding_; }

  document::WholePose pose(double frame) const;
  /// Returns the model's probes, posed by `pose`. Locked probes ignore `pose`.
  pose::Probes probes(const document::WholePose& pose) const;

  /// Deforms the model in double precision. The result has the same bits as the result of deform_exactly().
  deform::ExactModel exact(const document::WholePose& pose, base::Progress* progress = nullptr);
  /// Computes x, y, z of every vertex with precision(), rounded to float. Valid until the next floats().
  std::span<const float> floats(double frame);
  std::vector<mesh::Point> positions(double frame);
  /// Returns messages for the user about the last computed frame, one line each.
  const std::vector<std::string>& notes() const { return notes_; }

private:
  bool has_cage() const { return model_.cage->element_count() > 0; }
  bool can_fuse() const;
  void take_notes(const pose::LogReport& report, const document::WholePose& pose,
                  const std::vector<std::string>& warnings);
  void make_fast(double most, std::span<const double> tried, base::Progress* progress);
  void run_fast(double frame);

  const Export& model_;
  base::WorkerPool& pool_;
  document::VectorCache vectors_;
  std::optional<document::Animation> animation_;
  std::unique_ptr<deform::FrameDeformer> deformer_;  // null for Precision::exact
  std::unique_ptr<deform::ExactDeformer> exact_;     // created when first needed
  double error_ = 0;                                 // the largest sampled error so far
  double rounding_ = 0;
  std::vector<float> floats_;
  std::vector<std::string> notes_;
};

}  // namespace viete::files
