// Times of the last frames, and accuracy and speed of each method on the matrices of a frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/field.h"
#include "base/worker_pool.h"
#include "mesh/surface.h"
#include "pose/stages.h"
#include "sym3/exp.h"

namespace viete::workspace {

using analysis::compared_methods;
using pose::Stage;
using pose::stage_count;
using pose::StageTimes;
using sym3::Method;

/// Wall times of one frame in milliseconds.
struct FrameTimes {
  double when = 0;  ///< seconds on a monotonic clock
  Method method = Method::fast;
  pose::StageTimes stages;  ///< times of the stages; zero if the model was not deformed
  double upload = 0, draw = 0, panels = 0;
  double frame = 0;               ///< total, from input to the finished picture
  base::WorkerPool::Cost cost{};  ///< of loops and panels; seconds
  bool busy = false;  ///< of a median: other programs took processor time, so that the times are too long
};

/// The median of each time. Other members are from the last frame. `frames` must not be empty. `busy` is true
/// if a quarter of the wall time in `cost`, and half a millisecond per frame, is not processor time.
FrameTimes median_of(std::span<const FrameTimes> frames);

/// Medians of frame times. Frames that deformed the model are separate from frames that only drew the model.
class FrameStats {
public:
  void add(const FrameTimes& times);

  /// Medians over the last half second, updated about four times a second. If the newest frame deformed
  /// the model, the medians are over frames that deformed the model. Otherwise, the medians are over frames
  /// that only drew the model. Nullopt until the first frame that deforms the model.
  const std::optional<FrameTimes>& median() const { return median_; }
  const std::optional<FrameTimes>& deforming_median() const { return deforming_median_; }
  void clear() { *this = {}; }

private:
  std::vector<FrameTimes> deforming_, drawing_;
  std::optional<FrameTimes> median_, deforming_median_;
  double due_ = 0;  // time of the next update, on the clock of FrameTimes::when
};

/// Results of one method on a sample of the frame's matrices.
struct MethodSample {
  double ns_per_matrix = 0;  ///< CPU time
  /// Largest relative Frobenius error against a 106-bit reference; NaN if a result was NaN.
  double worst_error = 0;
  double median_error = 0;
};

/// Results of all methods on the same matrices; measured in the background, a few times a second.
struct MethodStats {
  std::array<MethodSample, compared_methods.size()> samples{};
  std::size_t matrices = 0;  ///< size of the sample; 0 before the first measurement
};

/// Times of one deformation of the current pose with each method. Measured after the panels are drawn, by
/// app/method_measuring.h; the next frame shows them.
struct MethodTimes {
  static constexpr std::size_t fused = compared_methods.size();
  /// compared_methods in the staged or stitched engine, then `fast` in the fused engine; all 0: not measured
  std::array<pose::StageTimes, fused + 1> stages{};
  double fused_error = 0;  ///< of the frame in the fused engine: see FrameDeformer::sampled_error()
  bool measured = false;   ///< true: measured in the background; false: times of drawn frames
  bool busy = false;       ///< see FrameTimes::busy
};

/// The last computed values of the map that colours the model.
struct FieldView {
  analysis::FieldStats stats;
  std::shared_ptr<const std::vector<float>> values;  ///< one per vertex; null: none
  std::string problem{};                             ///< why there are no values; empty: no problem
  bool holds_range = false;                          ///< true: the colour range is locked
  std::pair<double, double> own_range{};             ///< the colour range without the other views
};

/// The vertex inspector's data for a picked vertex.
struct VertexView {
  /// The contribution of one element of the cage.
  struct Term {
    std::uint32_t element;
    double weight;
    mesh::Point at;                     ///< the element's center, file units
    std::array<double, 3> eigenvalues;  ///< eigenvalues of the sum of weight * log up to this term, ascending
  };
  /// The result of one method for the exponential of the sum of all terms.
  struct Evaluation {
    Method method;
    std::string route;  ///< the algorithm, in words
    double error;       ///< relative, against a 106-bit reference
  };

  std::optional<std::uint32_t> vertex;  ///< the picked vertex
  bool appearing = false;               ///< the vertex was just picked: scroll to the inspector
  std::vector<Term> terms;              ///< by decreasing weight
  bool has_logs = false;                ///< false: terms have weights, but no logs
  glm::dmat3 map{1};                    ///< deformation matrix of the sum of all terms
  double degrees = 0;                   ///< rotation angle of the map
  std::vector<Evaluation> evaluations;
};

}  // namespace viete::workspace
