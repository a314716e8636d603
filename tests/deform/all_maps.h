// Computes all maps of a cage.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "deform/maps.h"

namespace viete::test {

inline std::vector<std::uint32_t> first(std::size_t count) {
  std::vector<std::uint32_t> elements(count);
  std::iota(elements.begin(), elements.end(), 0u);
  return elements;
}

inline std::vector<deform::AffineMap> maps_of(const deform::Cage& cage, std::span<const mesh::Point> posed) {
  std::vector<deform::AffineMap> maps(cage.element_count());
  face_maps(cage, posed, pose_origin(cage, posed), first(maps.size()), maps);
  return maps;
}

}  // namespace viete::test
