// Morph targets of glTF and the animation of their weights.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "mesh/surface.h"

namespace viete::formats {

/// Morph targets and their weights over time. Each moment adds the weighted offsets of all targets to the
/// rest model. Weights are interpolated linearly between moments.
struct MorphMotion {
  std::string name;
  std::vector<double> seconds;       ///< times of the moments, ascending
  std::vector<std::string> targets;  ///< names, may be empty
  std::vector<float> weights;        ///< targets.size() weights per moment
  std::vector<char> moves;           ///< for each vertex, whether a target moves it
  std::function<std::vector<mesh::Point>(std::size_t target)>
      positions;  ///< called once per target, in order
  bool normals = true;
};

/// Throws base::Error without moments, for times that do not ascend, or if sizes do not match.
void check_motion(const MorphMotion& motion, std::size_t vertices);

/// Morph animation of a glTF file. Positions are computed on demand. Immutable and thread-safe.
class MorphClip {
public:
  virtual ~MorphClip() = default;

  const std::string& name() const { return name_; }                ///< animation name; may be empty
  const std::vector<double>& seconds() const { return seconds_; }  ///< key times, ascending; may be empty
  const std::vector<std::string>& targets() const { return targets_; }  ///< names, not empty
  const std::vector<std::string>& notes() const { return notes_; }      ///< deviations from the file

  /// Positions of the surface at a key, or with one target at full weight. Between keys, interpolate
  /// linearly. Throws base::Error if the file's data are invalid.
  virtual std::vector<mesh::Point> at_key(std::size_t key) const = 0;
  virtual std::vector<mesh::Point> at_target(std::size_t target) const = 0;

protected:
  std::string name_;
  std::vector<double> seconds_;
  std::vector<std::string> targets_, notes_;
};

}  // namespace viete::formats
