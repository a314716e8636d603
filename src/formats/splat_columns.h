// The numbers of splats as columns, in the order and with the names of PLY captures.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "mesh/splats.h"

namespace viete::formats {

/// One number of each splat.
template <class Float>
struct SplatColumn {
  Float* first = nullptr;
  std::size_t stride = 0;

  Float& operator[](std::size_t splat) const { return first[splat * stride]; }
};

inline void resize(mesh::Splats& splats, std::size_t count) {
  splats.log_scales.resize(count);
  splats.rotations.resize(count);
  splats.opacities.resize(count);
  splats.colors.resize(count);
  splats.harmonics.resize(3 * splats.bands() * count);
}

/// Returns the columns f_dc_0 to 2, f_rest_*, opacity, scale_0 to 2, rot_0 to 3. Without splats, returns
/// none.
template <class Splats>
auto splat_columns(Splats& splats) {
  using Float = std::conditional_t<std::is_const_v<Splats>, const float, float>;
  std::vector<SplatColumn<Float>> columns;
  if (splats.size() == 0) return columns;
  const auto add = [&](Float* first, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) columns.push_back({first + k, count});
  };
  add(splats.colors[0].data(), 3);
  if (splats.degree > 0) add(splats.harmonics.data(), 3 * splats.bands());
  add(splats.opacities.data(), 1);
  add(splats.log_scales[0].data(), 3);
  add(splats.rotations[0].data(), 4);
  return columns;
}

/// Returns the names of splat_columns() in a file with `in_file` harmonics for each colour, at least `bands`.
inline std::vector<std::string> splat_names(std::size_t bands, std::size_t in_file) {
  std::vector<std::string> names;
  const auto add = [&](const char* name, std::size_t first, std::size_t count) {
    for (std::size_t k = first; k < first + count; ++k) names.push_back(name + std::to_string(k));
  };
  add("f_dc_", 0, 3);
  for (std::size_t color = 0; color < 3; ++color) add("f_rest_", color * in_file, bands);
  names.emplace_back("opacity");
  add("scale_", 0, 3);
  add("rot_", 0, 4);
  return names;
}

/// Returns the largest degree, at most 3, whose harmonics are all among this number of harmonics.
inline int whole_degree(std::size_t harmonics) {
  return harmonics >= 15 ? 3 : harmonics >= 8 ? 2 : harmonics >= 3 ? 1 : 0;
}

}  // namespace viete::formats
