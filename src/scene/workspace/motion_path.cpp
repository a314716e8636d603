#include "scene/workspace/motion_path.h"

#include <algorithm>
#include <cmath>

#include "scene/document/elements.h"

namespace viete::scene {

namespace {

constexpr std::size_t most_samples = 120, least_samples = 12;
constexpr std::size_t most_sampled = 600'000;  // vertices of shapes in all

// Every key, and between two of them as many as there is room for.
MotionPaths frames_of(const Timeline& timeline, std::size_t samples) {
  MotionPaths paths;
  const auto& keys = timeline.keys;
  const double length = keys.back().frame - keys.front().frame;
  const double step = std::max(1.0, length / static_cast<double>(samples));
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

// Selected ones, or else all.
std::vector<std::uint32_t> pinned_vertices(const Document& document) {
  std::vector<std::uint32_t> selected, all;
  for (std::uint32_t i = 0; i < document.probes.all.size(); ++i) {
    const deform::Probe& probe = document.probes.all[i];
    if (!probe.pin) continue;
    all.push_back(probe.pin->vertex);
    if (document.selection.kind() == ElementKind::probe && document.selection.contains(i))
      selected.push_back(probe.pin->vertex);
  }
  return selected.empty() ? all : selected;
}

}  // namespace

MotionPaths motion_paths(const Animation& animation, const Timeline& timeline,
                         std::span<const std::uint32_t> vertices, const mesh::Surface* model) {
  const std::size_t size = model ? model->positions.size() : 1;
  MotionPaths paths = frames_of(timeline, std::clamp(most_sampled / size, least_samples, most_samples));
  const auto place = [&](const WholePose& pose, std::uint32_t v) {
    if (!model) return pose.cage.positions[v];
    return pose.shape ? (*pose.shape)[v] : model->positions[v];
  };
  for (const auto v : vertices.first(std::min(vertices.size(), most_paths)))
    paths.paths.push_back({v, {}, {}});
  for (const double frame : paths.frames) {
    const WholePose by_logs = animation.at(frame, false), straight = animation.at(frame, true);
    for (MotionPath& path : paths.paths) {
      path.by_logs.push_back(place(by_logs, path.vertex));
      path.straight.push_back(place(straight, path.vertex));
    }
  }
  return paths;
}

const MotionPaths& KnownPaths::of(const Document& document, std::shared_ptr<const Animation> animation) {
  const bool of_cage = document.has_cage() && document.selection.kind() != ElementKind::probe;
  std::vector<std::uint32_t> vertices;
  if (of_cage) vertices = selected_vertices(*document.cage, document.selection);
  if (!document.has_cage()) vertices = pinned_vertices(document);
  if (animation == animation_ && vertices == vertices_) return paths_;
  animation_ = std::move(animation);
  vertices_ = std::move(vertices);
  const mesh::Surface* model = of_cage ? nullptr : document.model.surface.get();
  paths_ = animation_ && !vertices_.empty() ? motion_paths(*animation_, document.timeline, vertices_, model)
                                            : MotionPaths{};
  return paths_;
}

}  // namespace viete::scene
