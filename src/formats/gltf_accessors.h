// Reads numbers from the buffers of a glTF file, with bounds checks. Finds numbers that can be changed in
// place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/byte_order.h"
#include "formats/gltf_file.h"

namespace viete::formats {

/// Returns the type of a component type of the glTF specification, or nullopt for other numbers.
std::optional<base::NumberType> gltf_number_type(int component_type);

/// Returns the number of components of a vector or scalar ("VEC3"). Returns 0 for matrices, which surfaces do
/// not use.
std::size_t gltf_component_count(const std::string& type);

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

/// Finds accessors whose bytes no other accessor or image uses. Such accessors can be changed in place. Later
/// changes of the document have no effect here. `accessors` must outlive this object.
class GltfSharing {
public:
  GltfSharing(const GltfJson& document, const GltfAccessors& accessors);

  std::size_t uses(std::size_t accessor) const { return uses_[accessor]; }

  /// Returns true for elements of `components` floats, if no other accessor or image uses the same bytes.
  bool is_alone(int accessor, std::size_t components);

private:
  struct Bytes {
    std::size_t buffer, begin, end, stride;
    std::size_t accessor;      // npos for an image
    std::size_t furthest = 0;  // largest `end` of this and all previous ranges of the same buffer

    friend bool operator<(const Bytes& a, const Bytes& b) {
      return std::tie(a.buffer, a.begin) < std::tie(b.buffer, b.begin);
    }
  };

  void count_uses(const GltfJson& document);
  void list_bytes(const GltfJson& document);
  static Bytes bytes_of(const GltfPlace& place, std::size_t accessor);
  bool interleaved(const GltfPlace& a, const Bytes& other) const;

  const GltfAccessors& accessors_;
  std::vector<std::size_t> uses_;
  std::vector<Bytes> bytes_;  // the used ranges, sorted by start
  std::size_t comparisons_ = 0;
};

}  // namespace viete::formats
