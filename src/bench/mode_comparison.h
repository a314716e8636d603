// Results of the comparison of schemes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bench/models.h"
#include "deform/cage.h"
#include "deform/scheme.h"

namespace viete::bench {

struct NamedPose {
  std::string name;
  deform::Pose pose;
};

/// Measures of a deformed model relative to the model at rest.
struct ShapeQuality {
  Distortion distortion;
  double bending = 0;  ///< RestModel::bending()
  double volume = 1;   ///< relative to rest; NaN if the model encloses none
  double gap = 0;      ///< see bench::gap()
  double torn = 0;     ///< see bench::torn()
  /// Relative to mean value coordinates in the same run; NaN if those are nearly 0 or not measured.
  double energy_ratio = 0, bending_ratio = 0, torn_ratio = 0;
};

/// Results of one scheme.
struct Mode {
  deform::Scheme scheme;
  std::string problem;                  ///< why it is not available for this model and cage; empty: available
  std::array<double, 4> deviations{};   ///< of whole_poses()
  double leak = 0;                      ///< see bench::leak()
  std::vector<ShapeQuality> qualities;  ///< one per pose
  bool fused = false;                   ///< true if the timed frame is fused
  double frame_ms = 0, bind_ms = 0;     ///< processor time of one thread
};

/// Results of all schemes for one model in one cage.
struct ModeComparison {
  std::vector<Mode> modes;
  bool encloses = true;                 ///< the model has a volume to compare
  std::size_t without_area = 0;         ///< triangles of the model without area, left out
  double rest_gap = 0;                  ///< gap at rest, as a reference for poses
  std::vector<std::string> warnings{};  ///< warnings of the bindings, without duplicates
};

/// A map of space that poses the cage as a whole: x -> linear (x - middle) + middle + shift, middle being
/// that of the cage's box, shift in its diagonals.
struct WholePose {
  const char* name;
  sym3::Mat3<double> linear;
  mesh::Vec3 shift;
};
/// A translation, a rigid motion, a similarity and an affine pose, each not of a simpler kind.
std::span<const WholePose> whole_poses();

/// A deformation reproduces a pose if the deviation is at most this, the level of rounding.
inline constexpr double exactly = 1e-9;

}  // namespace viete::bench
