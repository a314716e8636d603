// Reads numbers from the buffers of a glTF file, with bounds checks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/gltf_file.h"

namespace viete::formats {

/// The location of an accessor's elements. All elements are within the buffer.
struct GltfPlace {
  /// The buffer has `count` elements of `size` bytes. Element i starts at byte `offset + i * stride`.
  std::size_t buffer = 0, offset = 0, stride = 0, count = 0, size = 0;
  bool has_bytes = false;  ///< false: all elements are 0, except sparse values
};

/// The file must outlive this object. If an accessor is invalid, the functions throw base::Error.
class GltfAccessors {
public:
  explicit GltfAccessors(const GltfFile& file) : file_(file) {}

  std::size_t count(int accessor) const { return place(accessor).count; }

  /// Returns the number of components of each element, or 0 for a matrix.
  std::size_t components(int accessor) const { return at(accessor).components; }

  GltfPlace place(int accessor) const;

  /// Returns the first `components` numbers of each element. Normalized integers become 0 to 1 or -1 to 1.
  std::vector<double> numbers(int accessor, std::size_t components) const;

  /// Returns unsigned integers. Also throws base::Error if an integer is `limit` or more.
  std::vector<std::uint32_t> indices(int accessor, std::size_t limit) const;

  /// Returns true for float elements with this number of components and without sparse values.
  bool holds_floats(int accessor, std::size_t components) const;

  /// Throws base::Error about a part of the file, for example what = "buffer view" and index = 3.
  [[noreturn]] void fail(const std::string& what, int index, const std::string& problem) const;

private:
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
