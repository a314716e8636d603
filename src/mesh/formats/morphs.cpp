#include "mesh/formats/morphs.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/encoding.h"
#include "base/error.h"
#include "base/text.h"

namespace viete::mesh {

void check_animation(const MorphAnimation& animation, std::size_t vertices) {
  const auto& keys = animation.keys;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].positions.size() != vertices)
      throw base::Error("key " + std::to_string(i),
                        base::counted(keys[i].positions.size(), "position") + " for " +
                            base::counted(vertices, "vertex of the model"),
                        "take positions of the same model");
  }
}

void check_motion(const MorphMotion& motion, std::size_t vertices) {
  const auto& seconds = motion.seconds;
  if (seconds.empty()) throw base::Error("", "an animation without keys", "give it at least one");
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const bool ascends = i == 0 || static_cast<float>(seconds[i]) > static_cast<float>(seconds[i - 1]);
    if (!std::isfinite(seconds[i]) || !ascends)
      throw base::Error("key " + std::to_string(i), "its time does not come after that of the key before it",
                        "give each key its own time");
  }
  if (motion.moves.size() != vertices || motion.weights.size() != seconds.size() * motion.targets.size())
    throw base::Error("", "an animation of another model, or of other targets", "make it of this model");
}

MorphTargets morph_targets(const MorphAnimation& animation, std::span<const Point> rest) {
  MorphTargets found;
  std::unordered_multimap<std::uint64_t, std::size_t> known;
  for (const MorphKey& key : animation.keys) {
    std::size_t target = MorphTargets::npos;
    if (!std::ranges::equal(key.positions, rest)) {
      base::Checksum sum;
      sum.add(key.positions.data(), key.positions.size_bytes());
      const auto [first, last] = known.equal_range(sum.value());
      const auto same = std::find_if(first, last, [&](const auto& entry) {
        return std::ranges::equal(animation.keys[found.keys[entry.second]].positions, key.positions);
      });
      target = same == last ? found.keys.size() : same->second;
      if (same == last) {
        known.emplace(sum.value(), target);
        found.keys.push_back(static_cast<std::size_t>(&key - animation.keys.data()));
      }
    }
    found.target.push_back(target);
  }
  return found;
}

MorphMotion morph_motion(const MorphAnimation& animation, std::span<const Point> rest) {
  check_animation(animation, rest.size());
  const MorphTargets found = morph_targets(animation, rest);
  MorphMotion motion;
  motion.name = animation.name;
  motion.normals = animation.normals;
  motion.moves.assign(rest.size(), 0);
  for (const std::size_t key : found.keys) {
    motion.targets.push_back(animation.keys[key].name);
    for (std::size_t v = 0; v < rest.size(); ++v)
      motion.moves[v] |= animation.keys[key].positions[v] != rest[v];
  }
  motion.weights.assign(animation.keys.size() * found.keys.size(), 0);
  for (std::size_t key = 0; key < animation.keys.size(); ++key) {
    motion.seconds.push_back(animation.keys[key].seconds);
    if (found.target[key] != MorphTargets::npos)
      motion.weights[key * found.keys.size() + found.target[key]] = 1;
  }
  motion.positions = [&animation, keys = found.keys](std::size_t target) {
    const auto& positions = animation.keys[keys[target]].positions;
    return std::vector<Point>(positions.begin(), positions.end());
  };
  return motion;
}

}  // namespace viete::mesh
