// viete bench modes: every way of blending, side by side, on the poses of a model.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/mode_comparison.h"
#include "bench/rest_model.h"
#include "deform/cage.h"
#include "deform/scheme.h"
#include "sym3/exp.h"

namespace viete::bench {

struct ModeSettings {
  std::size_t rounds = 11;
  deform::PartialChoice choice{};  ///< if any: all ways of blending that have it, and mean value coordinates
  std::optional<double> radius{};  ///< of cut-off weights
  sym3::Method method = sym3::Method::fast;
  int iterations = 0;  ///< of stitching, where a way of blending can be stitched
  deform::Holding holding{};
  bool named_only = false;  ///< only ways that have names
};

struct ModesOptions {
  std::filesystem::path model, cage;
  std::vector<std::filesystem::path> poses;
  ModeSettings settings;
  std::filesystem::path json;  ///< the numbers go here too; empty: nowhere
};

/// The ways that have names and the other valid schemes that have what is chosen, measured in double, link by
/// link, stitched ones as they run; frames as the program would run them, one after the other, in interleaved
/// rounds, of the first pose. poses must not be empty. Throws base::Error, base::Cancelled.
ModeComparison measure_modes(const mesh::Surface& model, std::shared_ptr<const deform::Cage> cage,
                             std::span<const NamedPose> poses, const ModeSettings& settings,
                             base::Progress& progress);

/// Named by their files: "pose_alert.obj" is alert. Throws base::Error.
std::vector<NamedPose> read_poses(std::span<const std::filesystem::path> files, const deform::Cage& cage,
                                  std::vector<std::string>& warnings);

/// Prints the tables. Throws base::Error.
void bench_modes(const ModesOptions& options);

}  // namespace viete::bench
