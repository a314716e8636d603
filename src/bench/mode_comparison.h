// Ways of blending, as they were measured side by side.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "bench/rest_model.h"
#include "deform/cage.h"
#include "deform/scheme.h"

namespace viete::bench {

struct NamedPose {
  std::string name;
  deform::Pose pose;
};

/// A deformed model beside the model at rest.
struct ShapeQuality {
  Distortion distortion;
  double bending = 0;  ///< RestModel::bending()
  double volume = 1;   ///< over that at rest; NaN where the model encloses none
  double gap = 0;      ///< see bench::gap()
  double torn = 0;     ///< see bench::torn()
  /// Over those of mean value coordinates in the same run; NaN where these have next to none, or are not
  /// there.
  double energy_ratio = 0, bending_ratio = 0, torn_ratio = 0;
};

/// One way of blending.
struct Mode {
  deform::Scheme scheme;
  std::string problem;                  ///< why it cannot be had of this model and cage; empty: it can
  std::array<double, 4> deviations{};   ///< of whole_poses()
  double leak = 0;                      ///< see bench::leak()
  std::vector<ShapeQuality> qualities;  ///< one a pose
  bool fused = false;                   ///< its frame, which is timed
  double frame_ms = 0, bind_ms = 0;     ///< processor time of one thread
};

/// All that are measured of one model in one cage.
struct ModeComparison {
  std::vector<Mode> modes;
  bool encloses = true;                 ///< the model has a volume to compare
  std::size_t without_area = 0;         ///< triangles of the model that are left out
  double rest_gap = 0;                  ///< with which to compare the gaps of poses
  std::vector<std::string> warnings{};  ///< of the bindings, each once
};

}  // namespace viete::bench
