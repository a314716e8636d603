#include "mesh/formats/spread_normals.h"

#include <algorithm>
#include <span>

namespace viete::mesh {

namespace {

// What the corners that share a normal must have in common: their polygon where faces are flat, else their
// vertex.
std::vector<std::uint64_t> common_to_corners(const Surface& surface, const Attributes& attributes) {
  std::vector<std::uint64_t> common(surface.corners.begin(), surface.corners.end());
  constexpr std::uint64_t polygons = std::uint64_t{1} << 32;
  for (std::size_t g = 0; g < attributes.groups.size(); ++g) {
    if (attributes.groups[g].smooth) continue;
    const std::size_t end =
        g + 1 < attributes.groups.size() ? attributes.groups[g + 1].first_polygon : surface.polygon_count();
    for (std::size_t p = attributes.groups[g].first_polygon; p < end; ++p) {
      for (auto c = surface.polygon_starts[p]; c < surface.polygon_starts[p + 1]; ++c)
        common[c] = polygons + p;
    }
  }
  return common;
}

// Corners with the same normal, one normal after the other.
struct CornersOfNormals {
  std::vector<std::uint32_t> starts, corners;

  CornersOfNormals(std::span<const std::uint32_t> corner_normal, std::size_t normals)
      : starts(normals + 2, 0) {
    for (const std::uint32_t n : corner_normal) {
      if (n != none) ++starts[n + 2];
    }
    for (std::size_t n = 2; n < starts.size(); ++n) starts[n] += starts[n - 1];
    corners.resize(starts.back());
    for (std::uint32_t c = 0; c < corner_normal.size(); ++c) {
      if (corner_normal[c] != none) corners[starts[corner_normal[c] + 1]++] = c;
    }
    starts.pop_back();
  }

  std::span<std::uint32_t> of(std::size_t normal) {
    return std::span(corners).subspan(starts[normal], starts[normal + 1] - starts[normal]);
  }
};

}  // namespace

SpreadNormals::SpreadNormals(const Surface& surface, const Attributes& attributes)
    : of_corner(surface.corners.size(), none) {
  const auto common = common_to_corners(surface, attributes);
  CornersOfNormals of_normals(attributes.corner_normal, attributes.normals.size());
  normals.reserve(attributes.normals.size());
  for (std::size_t n = 0; n < attributes.normals.size(); ++n) {
    first.push_back(static_cast<std::uint32_t>(normals.size()));
    normals.push_back(attributes.normals[n]);
    const auto corners = of_normals.of(n);
    if (corners.empty()) continue;
    const auto same = [&](std::uint32_t c) { return common[c] == common[corners[0]]; };
    if (!std::all_of(corners.begin(), corners.end(), same)) {
      std::stable_sort(corners.begin(), corners.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return common[a] < common[b]; });
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (i > 0 && common[corners[i]] != common[corners[i - 1]]) normals.push_back(attributes.normals[n]);
      of_corner[corners[i]] = static_cast<std::uint32_t>(normals.size() - 1);
    }
  }
  first.push_back(static_cast<std::uint32_t>(normals.size()));
}

}  // namespace viete::mesh
