// Captures (Gaussian splats) in PLY files: finds, reads and rewrites the numbers of splats.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/file_vectors.h"
#include "formats/original.h"
#include "formats/ply_file.h"
#include "formats/splat_columns.h"
#include "mesh/splats.h"

namespace viete::formats {

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
