// The ways of vertices of the cage, or of pins of a model without one, over all keys, in log space and
// straight: what playing shows, at a glance.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scene/document/animation.h"
#include "scene/document/document.h"

namespace viete::scene {

struct MotionPath {
  using Places = std::vector<mesh::Point>;
  std::uint32_t vertex;
  Places by_logs, straight;  ///< a place a frame of MotionPaths::frames
};

struct MotionPaths {
  std::vector<double> frames;     ///< ascending, from the first key to the last
  std::vector<std::size_t> keys;  ///< which of the frames are keys
  std::vector<MotionPath> paths;
};

/// Of at most most_paths of the vertices, in their order: of the model's shape or, if that is null, of the
/// cage.
inline constexpr std::size_t most_paths = 24;
MotionPaths motion_paths(const Animation& animation, const Timeline& timeline,
                         std::span<const std::uint32_t> vertices, const mesh::Surface* model = nullptr);

/// Made when they are asked for, and kept until timeline, cage or selection change.
class KnownPaths {
public:
  /// Of the selected vertices or pins; empty where there is nothing that moves.
  const MotionPaths& of(const Document& document, std::shared_ptr<const Animation> animation);

private:
  std::shared_ptr<const Animation> animation_;
  std::vector<std::uint32_t> vertices_;
  MotionPaths paths_;
};

}  // namespace viete::scene
