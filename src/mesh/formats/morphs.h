// Morph targets of glTF: positions that a model's vertices take one after another, as an animation of
// weights.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Morph targets and how they are mixed: at each moment the differences of all targets from the model at rest
/// are added, each times its weight. Between moments weights go straight.
struct MorphMotion {
  std::string name;
  std::vector<double> seconds;       ///< of the moments; they ascend
  std::vector<std::string> targets;  ///< their names, which may be empty
  std::vector<float> weights;        ///< of each moment as many as there are targets
  std::vector<char> moves;           ///< of each vertex, whether a target has it elsewhere than at rest
  std::function<std::vector<Point>(std::size_t target)> positions;  ///< asked for once each, in order
  bool normals = true;
};

/// Throws base::Error where there is no moment, times do not ascend, or numbers do not go together.
void check_motion(const MorphMotion& motion, std::size_t vertices);

/// What a glTF file says of how its meshes morph. Positions are made when they are asked for. Immutable and
/// thread-safe.
class MorphClip {
public:
  virtual ~MorphClip() = default;

  const std::string& name() const { return name_; }                     ///< of the animation; or empty
  const std::vector<double>& seconds() const { return seconds_; }       ///< of its keys, ascending; or none
  const std::vector<std::string>& targets() const { return targets_; }  ///< their names, none empty
  const std::vector<std::string>& notes() const {
    return notes_;
  }  ///< what is taken otherwise than the file has it

  /// Positions of the surface that was read, at a key, or with one target alone at full weight. Between keys
  /// they go straight. Throws base::Error where the file's numbers are not sound.
  virtual std::vector<Point> at_key(std::size_t key) const = 0;
  virtual std::vector<Point> at_target(std::size_t target) const = 0;

protected:
  std::string name_;
  std::vector<double> seconds_;
  std::vector<std::string> targets_, notes_;
};

}  // namespace viete::mesh
