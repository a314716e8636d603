// Computes all maps of a cage.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "pose/maps.h"

namespace viete::test {

inline std::vector<std::uint32_t> first(std::size_t count) {
  std::vector<std::uint32_t> elements(count);
  std::iota(elements.begin(), elements.end(), 0u);
  return elements;
}

inline std::vector<pose::AffineMap> maps_of(const pose::Cage& cage, std::span<const mesh::Point> posed) {
  std::vector<pose::AffineMap> maps(cage.element_count());
  face_maps(cage, posed, pose_origin(cage, posed), first(maps.size()), maps);
  return maps;
}

}  // namespace viete::test
