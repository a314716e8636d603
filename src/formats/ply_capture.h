// Captures (Gaussian splats) in PLY files: finds, reads and rewrites the numbers of splats.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "formats/file_vectors.h"
#include "formats/original.h"
#include "formats/ply_file.h"
#include "mesh/splats.h"

namespace viete::formats {

/// One number of each splat.
template <class Float>
struct SplatColumn {
  Float* first = nullptr;
  std::size_t stride = 0;

  Float& operator[](std::size_t splat) const { return first[splat * stride]; }
};

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

/// The properties that store splats.
struct PlySplats {
  int degree = 0;
  std::vector<std::size_t>
      properties;                  ///< for each column its property, or the number of properties if missing
  std::vector<std::string> notes;  ///< about missing colours and incomplete harmonics

  /// The header must satisfy capture() == Capture::splats.
  explicit PlySplats(const PlyElement& vertices);

  /// Allocates splats with all numbers 0. Throws base::Error if memory is short.
  mesh::Splats allocate(const std::string& file, std::size_t count) const;
};

/// Reads the numbers of binary rows on all processors. `rows` must be complete.
void read_splats(const PlySplats& found, const PlyElement& vertices, std::string_view rows, std::endian order,
                 mesh::Splats& splats);

/// A capture to write again. Rewriting changes x y z and the numbers of splats that differ from the file.
struct PlyCaptureFile {
  NumberForm form;
  PlyElement vertices;
  PlySplats found;
  std::size_t first_row = 0;  ///< the offset of the first vertex in the file
  std::shared_ptr<const mesh::Splats> splats;
  std::vector<std::string> beyond_attributes;  ///< see Original::beyond_attributes()
};

/// Returns null if source.owner is null.
std::shared_ptr<const Original> original_of_capture(const Source& source, PlyCaptureFile file);

}  // namespace viete::formats
