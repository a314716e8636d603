// Morph targets of glTF and the animation of their weights.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "mesh/surface.h"

namespace viete::formats {

/// Morph targets and their weights over time. The positions at a key are the rest positions plus the weighted
/// offsets of all targets. Between keys, weights are interpolated linearly.
struct MorphMotion {
  std::string name;
  std::vector<double> seconds;       ///< times of the keys in ascending order
  std::vector<std::string> targets;  ///< a name for each target; a name may be empty
  std::vector<float> weights;        ///< targets.size() weights for each key
  std::vector<char> moves;           ///< for each vertex, true if a target moves the vertex
  /// Returns the positions at full weight of the target. Called once for each target, in order.
  std::function<std::vector<mesh::Point>(std::size_t target)> positions;
  bool normals = true;  ///< true to animate normals and tangents too
};

/// If there are no keys, times do not increase, or sizes do not match, throws base::Error.
void check_motion(const MorphMotion& motion, std::size_t vertices);

/// The weights between two keys: constant, linear, or anything else.
enum class MorphCurve { held, linear, other };

/// The morph animation of a glTF file. Computes positions only on request. Immutable and thread-safe.
class MorphClip {
public:
  virtual ~MorphClip() = default;

  const std::string& name() const { return name_; }                     ///< animation name; may be empty
  const std::vector<double>& seconds() const { return seconds_; }       ///< ascending; may be empty
  const std::vector<MorphCurve>& curves() const { return curves_; }     ///< after each key but the last
  const std::vector<std::string>& targets() const { return targets_; }  ///< a non-empty name for each target
  const std::vector<std::string>& notes() const { return notes_; }      ///< messages about ignored content

  /// Returns the positions of the surface. If the file contains invalid data, throws base::Error.
  virtual std::vector<mesh::Point> at(double second) const = 0;
  std::vector<mesh::Point> at_key(std::size_t key) const { return at(seconds_[key]); }
  /// Returns the positions with one target at full weight and all others at 0. Throws like at().
  virtual std::vector<mesh::Point> at_target(std::size_t target) const = 0;

protected:
  std::string name_;
  std::vector<double> seconds_;
  std::vector<MorphCurve> curves_;
  std::vector<std::string> targets_, notes_;
};

}  // namespace viete::formats
