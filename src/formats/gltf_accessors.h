// Access to the numbers in a glTF file's buffers, with bounds checks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/gltf_file.h"
#include "mesh/vector.h"

namespace viete::formats {

/// Location of an accessor's elements, entirely within the buffer.
struct GltfPlace {
  std::size_t buffer = 0, offset = 0, stride = 0, count = 0, size = 0;  ///< size: bytes per element
  bool has_bytes = false;  ///< false: all zeros, except for sparse values
};

/// Borrows the file.
class GltfAccessors {
public:
  explicit GltfAccessors(const GltfFile& file) : file_(file) {}

  /// The number of elements. Throws base::Error naming the accessor if it exceeds its buffer.
  std::size_t count(int accessor) const { return place(accessor).count; }

  /// Components per element; 0 for a matrix.
  std::size_t components(int accessor) const;

  GltfPlace place(int accessor) const;

  /// `components` numbers per element: floats, or integers (normalized ones scaled to [0, 1] or [-1, 1]).
  /// Three components of a four-component accessor may be read. Throws base::Error.
  std::vector<double> numbers(int accessor, std::size_t components) const;

  /// Unsigned integers. Throws base::Error also if one is not below `limit`.
  std::vector<std::uint32_t> indices(int accessor, std::size_t limit) const;

  /// True for float elements of that many components without sparse values.
  bool holds_floats(int accessor, std::size_t components) const;

  [[noreturn]] void fail(const std::string& what, int index, const std::string& problem) const;

private:
  // An accessor as described by the JSON.
  struct Accessor {
    int component = 0;
    std::size_t components = 0, count = 0;
    bool normalized = false;
    const GltfJson& json;
    const GltfJson& sparse;

    std::size_t size() const;
  };

  Accessor at(int accessor) const;
  GltfPlace of_view(int accessor, const GltfJson& data, std::size_t count, std::size_t size) const;
  void put_sparse(int index, const Accessor& accessor, std::size_t components,
                  std::vector<double>& numbers) const;
  const char* bytes(const GltfPlace& place) const {
    return file_.buffers[place.buffer].bytes.data() + place.offset;
  }

  const GltfFile& file_;
};

}  // namespace viete::formats
