// Links: the steps that compute a frame, and their times.
#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <string_view>

namespace viete::pose {

/// A step in the computation of a frame. `fused` combines blend, exp and apply in one pass. `skeleton` blends
/// pivots (see LeafFactors). `triangle_maps` and `solve` are the iterations of stitching.
enum class Link { maps, log_maps, blend, exp, apply, skeleton, fused, triangle_maps, solve, probes, normals };
inline constexpr std::size_t link_count = 11;

constexpr std::string_view name(Link link) {
  constexpr std::array<std::string_view, link_count> names = {"maps",  "log maps", "blend",  "exp",
                                                              "apply", "skeleton", "fused",  "triangles",
                                                              "solve", "probes",   "normals"};
  return names[static_cast<std::size_t>(link)];
}

/// Elapsed milliseconds of each link in one frame; 0 for links that the frame does not use.
struct LinkTimes {
  std::array<double, link_count> ms{};

  double& operator[](Link link) { return ms[static_cast<std::size_t>(link)]; }
  double operator[](Link link) const { return ms[static_cast<std::size_t>(link)]; }
  double total() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }
  LinkTimes& operator+=(const LinkTimes& other) {
    for (std::size_t i = 0; i < link_count; ++i) ms[i] += other.ms[i];
    return *this;
  }
};

}  // namespace viete::pose
