// Timings of the last frames, and accuracy and speed of each method on their matrices.
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
#include "deform/links.h"
#include "mesh/surface.h"
#include "sym3/exp.h"

namespace viete::workspace {

// Names used by panels.
using analysis::compared_methods;
using deform::Link;
using deform::link_count;
using deform::LinkTimes;
using sym3::Method;

/// One frame, in milliseconds of wall time.
struct FrameTimes {
  double when = 0;  ///< seconds on a monotonic clock
  Method method = Method::fast;
  deform::LinkTimes links;  ///< zero if the cage did not move
  double upload = 0, draw = 0, panels = 0;
  double frame = 0;  ///< total, from input to the finished picture
};

/// Componentwise medians; other members are those of the last frame. `frames` must not be empty.
FrameTimes median_of(std::span<const FrameTimes> frames);

/// Medians for the timing panel: over frames deformed with the newest frame's method, and over later frames
/// that only drew the model, as when the camera moves.
class FrameStats {
public:
  void add(const FrameTimes& times);

  /// Componentwise medians over the last half second of frames of the newest one's type, deformed or only
  /// drawn; nullopt before the first deformed frame. Updated at most four times a second for readability.
  const std::optional<FrameTimes>& median() const { return median_; }
  /// The median of deformed frames.
  const std::optional<FrameTimes>& deforming_median() const { return deforming_median_; }
  void clear() { *this = {}; }

private:
  std::vector<FrameTimes> deforming_, drawing_;
  std::optional<FrameTimes> median_, deforming_median_;
  double due_ = 0;  ///< seconds on the same clock
};

/// Results of one method on a sample of the frame's matrices.
struct MethodSample {
  double ns_per_matrix = 0;  ///< CPU time
  double worst_error =
      0;  ///< largest relative Frobenius error against a 106-bit reference; NaN if a result was NaN
  double median_error = 0;
};

/// Results of all methods on the same matrices; measured in the background, a few times a second.
struct MethodStats {
  std::array<MethodSample, compared_methods.size()> samples{};
  std::size_t matrices = 0;  ///< in the sample; 0 until the first measurement
};

/// Times of one deformation of the current pose with each method, in the order of compared_methods.
struct MethodTimes {
  std::array<deform::LinkTimes, compared_methods.size()> links{};  ///< all 0: not measured
  bool measured = false;  ///< in the background; false: from frames only
};

/// The field shown as colours on the mesh, as last computed; some fields are computed in the background.
struct FieldView {
  analysis::FieldStats stats;
  std::shared_ptr<const std::vector<float>> values;  ///< one of the kinds in stats; null: none
  std::string problem{};  ///< why there are no values; empty: available, or being computed
  /// Fixes the colour range.
  bool holds_range = false;
};

/// The vertex inspector's data for a picked vertex.
struct VertexView {
  /// One element of the cage and its contribution.
  struct Term {
    std::uint32_t element;
    double weight;
    mesh::Point at;                     ///< the element's center, file units
    std::array<double, 3> eigenvalues;  ///< eigenvalues of the symmetric sum up to this term, ascending
  };
  /// The exponential of the whole sum by one method.
  struct Way {
    Method method;
    std::string route;
    double error;  ///< relative, against 106 bits
  };

  std::optional<std::uint32_t> vertex;  ///< the picked vertex
  bool appearing = false;               ///< just picked: scroll to its section
  std::vector<Term> terms;              ///< by decreasing weight
  bool has_logs = false;                ///< false: weights only
  glm::dmat3 map{1};                    ///< map of the whole sum
  double degrees = 0;                   ///< rotation angle of the map
  std::vector<Way> ways;
};

}  // namespace viete::workspace
