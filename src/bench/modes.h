// viete bench modes: every way of blending, side by side, on the poses of a model.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/rest_model.h"
#include "deform/cage.h"
#include "deform/scheme.h"
#include "sym3/exp.h"

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

struct ModeSettings {
  std::size_t rounds = 11;
  deform::PartialChoice
      choice{};  ///< only ways of blending that have all of this, and mean value coordinates
  deform::AskedWeighting weighting{};
  sym3::Method method = sym3::Method::fast;
  int iterations = 0;  ///< of stitching, where a way of blending can be stitched
  deform::Holding holding{};
};

struct ModesOptions {
  std::filesystem::path model, cage;
  std::vector<std::filesystem::path> poses;
  ModeSettings settings;
  std::filesystem::path json;  ///< the numbers go here too; empty: nowhere
};

/// deform::all_schemes(), as far as they are chosen, measured in double, link by link, stitched ones as they
/// run; frames as the program would run them, one after the other, in interleaved rounds, of the first pose.
/// poses must not be empty. Throws base::Error.
ModeComparison measure_modes(const mesh::Surface& model, std::shared_ptr<const deform::Cage> cage,
                             std::span<const NamedPose> poses, const ModeSettings& settings);

/// Prints the tables. Throws base::Error.
void bench_modes(const ModesOptions& options);

}  // namespace viete::bench
