// The links of a frame, and their times.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace viete::deform {

/// `fused` is blend, exp and apply in one pass; `skeleton` the blend of the vertices that compressed weights
/// interpolate; `triangle_maps` and `solve` belong to stitching and cover all iterations; `probes` is their
/// layer.
enum class Link { maps, log_maps, blend, exp, apply, skeleton, fused, triangle_maps, solve, probes, normals };
inline constexpr std::size_t link_count = 11;
std::string_view name(Link link);

/// Wall milliseconds of each link in one frame; links that the frame does not have stay 0.
struct LinkTimes {
  std::array<double, link_count> ms{};

  double& operator[](Link link) { return ms[static_cast<std::size_t>(link)]; }
  double operator[](Link link) const { return ms[static_cast<std::size_t>(link)]; }
  double total() const;
  /// Adds the times of another part of the same frame.
  LinkTimes& operator+=(const LinkTimes& other);
};

}  // namespace viete::deform
