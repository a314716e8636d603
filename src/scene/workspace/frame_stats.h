// What the last frames cost, and how exact and fast each method was on their matrices.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deform/links.h"
#include "lab/field.h"
#include "mesh/surface.h"
#include "sym3/exp.h"

namespace viete::scene {

// What panels show of a frame.
using deform::Link;
using deform::link_count;
using deform::LinkTimes;
using lab::compared_methods;
using sym3::Method;

/// Milliseconds of wall time of one frame.
struct FrameTimes {
  double when = 0;  ///< seconds on a monotonic clock
  Method method = Method::fast;
  deform::LinkTimes links;  ///< zero if the cage did not move
  double upload = 0, draw = 0, panels = 0;
  double frame = 0;  ///< the whole, from input to the finished picture
};

/// Medians for the timing panel: of frames that deformed with the method of the newest one, and of frames
/// since then that only drew the model, as when the camera moves.
class FrameStats {
public:
  void add(const FrameTimes& times);

  /// Componentwise medians over the last half second of frames like the newest one, which deformed or did
  /// not; nothing before the first that deformed. Changes at most four times a second, so that it can be
  /// read.
  const std::optional<FrameTimes>& median() const { return median_; }
  /// The same of frames that deformed.
  const std::optional<FrameTimes>& deforming_median() const { return deforming_median_; }
  void clear() { *this = {}; }

private:
  std::deque<FrameTimes> deforming_, drawing_;
  std::optional<FrameTimes> median_, deforming_median_;
  double due_ = 0;  ///< seconds on the same clock
};

/// One method on a sample of the frame's matrices.
struct MethodSample {
  double ns_per_matrix = 0;  ///< processor time
  double worst_error =
      0;  ///< largest relative Frobenius error against a reference of 106 bits; NaN if an answer was NaN
  double median_error = 0;
};

/// All methods on the same matrices; measured aside, a few times a second.
struct MethodStats {
  std::array<MethodSample, compared_methods.size()> samples{};
  std::size_t matrices = 0;  ///< in the sample; 0 until the first measurement
};

/// Times of one deformation of the open pose with each method, in the order of compared_methods.
struct MethodTimes {
  std::array<deform::LinkTimes, compared_methods.size()> links{};  ///< all 0: not measured
  bool measured = false;                                           ///< in the background; else only by frames
};

/// The field that is shown as colours on the mesh, as it was computed last; some are computed aside.
struct FieldView {
  lab::FieldStats stats;
  std::shared_ptr<const std::vector<float>> values;  ///< as the stats say; null: none
  /// Pairs of ends, see lab::strokes(); null: the field has none.
  std::shared_ptr<const std::vector<mesh::Point>> strokes;
  std::string problem{};  ///< why there are no values; empty: they are there, or being computed
  /// The colours keep their range, whatever comes.
  bool holds_range = false;
};

}  // namespace viete::scene
