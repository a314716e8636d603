// Writes glTF models that are animated by morph targets.
#pragma once

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "formats/write.h"

namespace viete::test {

struct MorphKey {
  double seconds = 0;
  std::string name;
  std::span<const mesh::Point> positions;
};

struct MorphAnimation {
  std::string name;
  std::vector<MorphKey> keys;
  bool normals = true;
};

/// Writes one target for each key that is not at rest.
inline std::vector<std::string> write_morphs(const std::filesystem::path& path,
                                             const formats::Content& content,
                                             const formats::Original* original,
                                             const MorphAnimation& animation,
                                             base::Progress* progress = nullptr) {
  formats::MorphMotion motion;
  motion.name = animation.name;
  motion.normals = animation.normals;
  motion.moves.assign(content.positions.size(), 0);
  std::vector<const MorphKey*> shown;
  for (const MorphKey& key : animation.keys)
    if (!std::ranges::equal(key.positions, content.positions)) shown.push_back(&key);
  for (const MorphKey* key : shown) {
    motion.targets.push_back(key->name);
    for (std::size_t v = 0; v < key->positions.size(); ++v)
      motion.moves[v] |= key->positions[v] != content.positions[v];
  }
  for (const MorphKey& key : animation.keys) {
    motion.seconds.push_back(key.seconds);
    for (const MorphKey* target : shown) motion.weights.push_back(target == &key ? 1.0F : 0.0F);
  }
  motion.positions = [&](std::size_t t) {
    return std::vector<mesh::Point>(shown[t]->positions.begin(), shown[t]->positions.end());
  };
  return formats::write_animated(path, content, original, motion, progress);
}

}  // namespace viete::test
