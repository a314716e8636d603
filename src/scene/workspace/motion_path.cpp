#include "scene/workspace/motion_path.h"

#include <algorithm>
#include <cmath>

#include "scene/document/elements.h"

namespace viete::scene {

namespace {

constexpr std::size_t most_samples = 120;

// Every key, and between two of them as many as there is room for.
MotionPaths frames_of(const Timeline& timeline) {
  MotionPaths paths;
  const auto& keys = timeline.keys;
  const double length = keys.back().frame - keys.front().frame;
  const double step = std::max(1.0, length / most_samples);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    paths.keys.push_back(paths.frames.size());
    paths.frames.push_back(keys[k].frame);
    if (k + 1 == keys.size()) break;
    const double gap = keys[k + 1].frame - keys[k].frame;
    const auto pieces = std::max(1.0, std::ceil(gap / step));
    for (double i = 1; i < pieces; ++i) paths.frames.push_back(keys[k].frame + gap * i / pieces);
  }
  return paths;
}

}  // namespace

MotionPaths motion_paths(const Animation& animation, const Timeline& timeline,
                         std::span<const std::uint32_t> vertices) {
  MotionPaths paths = frames_of(timeline);
  for (const auto v : vertices.first(std::min(vertices.size(), most_paths)))
    paths.paths.push_back({v, {}, {}});
  for (const double frame : paths.frames) {
    const WholePose by_logs = animation.at(frame, false), straight = animation.at(frame, true);
    for (MotionPath& path : paths.paths) {
      path.by_logs.push_back(by_logs.cage.positions[path.vertex]);
      path.straight.push_back(straight.cage.positions[path.vertex]);
    }
  }
  return paths;
}

const MotionPaths& KnownPaths::of(const Document& document, std::shared_ptr<const Animation> animation) {
  const bool of_cage = document.has_cage() && document.selection.kind() != ElementKind::probe;
  std::vector<std::uint32_t> vertices;
  if (of_cage) vertices = selected_vertices(*document.cage, document.selection);
  if (animation == animation_ && vertices == vertices_) return paths_;
  animation_ = std::move(animation);
  vertices_ = std::move(vertices);
  paths_ = animation_ && !vertices_.empty() ? motion_paths(*animation_, document.timeline, vertices_)
                                            : MotionPaths{};
  return paths_;
}

}  // namespace viete::scene
