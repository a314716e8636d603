// What the last frames cost, and how exact and fast each method was on their matrices.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "deform/links.h"
#include "sym3/exp.h"

namespace viete::scene {

// What panels show of a frame.
using deform::Link;
using deform::link_count;
using sym3::Method;

/// Milliseconds of wall time of one frame.
struct FrameTimes {
  double when = 0;          ///< seconds on a monotonic clock
  deform::LinkTimes links;  ///< zero if the cage did not move
  double upload = 0, draw = 0, panels = 0;
  double frame = 0;  ///< the whole, from input to the finished picture

  double other() const { return frame - links.total() - upload - draw - panels; }
};

/// The history behind the timing panel: of frames that deformed, and of those since that only showed the
/// model anew, as when the camera moves.
class FrameStats {
public:
  void add(const FrameTimes& times);

  /// Componentwise medians over the last half second of frames like the newest one, which deformed or did
  /// not; nothing before the first that deformed.
  std::optional<FrameTimes> median() const;
  /// The same of those that deformed.
  std::optional<FrameTimes> deforming_median() const;
  /// Of deforming frames, oldest first, at most 240.
  const std::deque<FrameTimes>& history() const { return history_; }
  void clear() { history_.clear(), since_.clear(); }

private:
  std::deque<FrameTimes> history_;
  std::deque<FrameTimes> since_;  ///< that did not deform, since the last that did
};

/// One method on a sample of the frame's matrices.
struct MethodSample {
  double ns_per_matrix = 0;  ///< processor time
  double worst_error =
      0;  ///< largest relative Frobenius error against a reference of 106 bits; NaN if an answer was NaN
  double median_error = 0;
};

inline constexpr std::array compared_methods = {sym3::Method::diag, sym3::Method::sd,
                                                sym3::Method::improved_sd, sym3::Method::fast};

/// All methods on the same matrices; measured aside, a few times a second.
struct MethodStats {
  std::array<MethodSample, compared_methods.size()> samples{};
  std::size_t matrices = 0;  ///< in the sample; 0 until the first measurement
};

/// Errors of one method at every vertex of the mesh, measured aside while they are shown as colours.
struct ErrorMapStats {
  std::size_t vertices = 0;  ///< 0: not measured
  sym3::Method method = sym3::Method::fast;
  double worst = 0, median = 0;  ///< relative Frobenius errors; NaN if an answer was
  /// The colours run from 10^low to 10^high, whole numbers: the range of all methods in this pose, so that a
  /// switch is seen. What lies outside has the colour of the end.
  double low = -17, high = -14;
};

}  // namespace viete::scene
