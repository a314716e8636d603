// Access to the numbers in a glTF file's buffers, with bounds checks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "mesh/formats/gltf_file.h"
#include "mesh/vector.h"

namespace viete::mesh {

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
  const unsigned char* bytes(const GltfPlace& place) const {
    return reinterpret_cast<const unsigned char*>(file_.buffers[place.buffer].bytes.data()) + place.offset;
  }

  const GltfFile& file_;
};

/// Finds accessors that share no bytes with others, so that their values can be replaced in place. Reflects
/// the document at construction; borrows the document and accessors.
class GltfSharing {
public:
  GltfSharing(const GltfJson& document, const GltfAccessors& accessors);

  /// The number of references to the accessor in the document.
  std::size_t uses(std::size_t accessor) const { return uses_[accessor]; }

  /// True for float elements that share no byte with another accessor or image.
  bool is_alone(int accessor, std::size_t components);

private:
  struct Bytes {
    std::size_t buffer, begin, end, stride;
    std::size_t accessor;      // npos for an image
    std::size_t furthest = 0;  // largest end of the buffer's ranges up to this one

    friend bool operator<(const Bytes& a, const Bytes& b) {
      return std::tie(a.buffer, a.begin) < std::tie(b.buffer, b.begin);
    }
  };

  void count_uses(const GltfJson& document);
  void list_bytes(const GltfJson& document);
  void list_image(const GltfJson& view);
  static Bytes bytes_of(const GltfPlace& p, std::size_t accessor);
  bool interleaved(const GltfPlace& a, const Bytes& other) const;
  std::optional<GltfPlace> place_if_sound(int accessor) const;

  const GltfAccessors& accessors_;
  std::vector<std::size_t> uses_;
  std::vector<Bytes> bytes_;
  std::size_t comparisons_ = 0;
};

}  // namespace viete::mesh
