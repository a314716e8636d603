// Morph targets of glTF and the animation of their weights.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "mesh/surface.h"

namespace viete::formats {

/// Morph targets and their weights over time. The positions at a key are the rest positions plus the weighted
/// offsets of all targets. Weights are interpolated linearly between keys.
struct MorphMotion {
  std::string name;
  std::vector<double> seconds;       ///< times of the keys, ascending
  std::vector<std::string> targets;  ///< a name for each target; a name may be empty
  std::vector<float> weights;        ///< targets.size() weights per key
  std::vector<char> moves;           ///< for each vertex, whether a target moves it
  /// Returns the positions at full weight; called once per target, in order.
  std::function<std::vector<mesh::Point>(std::size_t target)> positions;
  bool normals = true;  ///< also animate normals and tangents
};

/// Throws base::Error if there are no keys, times do not increase, or sizes do not match.
void check_motion(const MorphMotion& motion, std::size_t vertices);

/// The morph animation of a glTF file, which computes positions on demand. Immutable and thread-safe.
class MorphClip {
public:
  virtual ~MorphClip() = default;

  const std::string& name() const { return name_; }                ///< animation name; may be empty
  const std::vector<double>& seconds() const { return seconds_; }  ///< key times, ascending; may be empty
  const std::vector<std::string>& targets() const { return targets_; }  ///< a non-empty name for each target
  const std::vector<std::string>& notes() const { return notes_; }      ///< differences from the file

  /// The positions of the surface at a key, or with only this target at full weight. Callers interpolate
  /// linearly between keys. Throws base::Error if the file contains invalid data.
  virtual std::vector<mesh::Point> at_key(std::size_t key) const = 0;
  virtual std::vector<mesh::Point> at_target(std::size_t target) const = 0;

protected:
  std::string name_;
  std::vector<double> seconds_;
  std::vector<std::string> targets_, notes_;
};

}  // namespace viete::formats
