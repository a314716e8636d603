#include "mesh/morphs.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/checksum.h"
#include "base/error.h"
#include "base/quantity.h"

namespace viete::mesh {

void check_animation(const MorphAnimation& animation, std::size_t vertices) {
  const auto& keys = animation.keys;
  if (keys.empty()) throw base::Error("", "an animation without keys", "give it at least one");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::string place = "key " + std::to_string(i);
    if (keys[i].positions.size() != vertices)
      throw base::Error(place,
                        base::counted(keys[i].positions.size(), "position") + " for " +
                            base::counted(vertices, "vertex of the model"),
                        "take positions of the same model");
    const bool ascends =
        i == 0 || static_cast<float>(keys[i].seconds) > static_cast<float>(keys[i - 1].seconds);
    if (!std::isfinite(keys[i].seconds) || !ascends)
      throw base::Error(place, "its time does not come after that of the key before it",
                        "give each key its own time");
  }
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

}  // namespace viete::mesh
