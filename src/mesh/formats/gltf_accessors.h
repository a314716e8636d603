// The numbers in a glTF file's buffers, every offset and index checked before it is followed.
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

/// Where the elements of an accessor lie. All of them are within the buffer.
struct GltfPlace {
  std::size_t buffer = 0, offset = 0, stride = 0, count = 0, size = 0;  ///< size: bytes of an element
  bool has_bytes = false;  ///< false: they are zeros, where no sparse value stands
};

/// Borrows the file.
class GltfAccessors {
public:
  explicit GltfAccessors(const GltfFile& file) : file_(file) {}

  /// The number of its elements. Throws base::Error naming the accessor if it does not fit its buffer.
  std::size_t count(int accessor) const { return place(accessor).count; }

  /// Of one element; 0 for a matrix.
  std::size_t components(int accessor) const;

  GltfPlace place(int accessor) const;

  /// `components` numbers of each element one after the other: floats, or integers as the accessor says they
  /// are meant (normalized: [0, 1] or [-1, 1]). An accessor of four components may be asked for three. Throws
  /// base::Error.
  std::vector<double> numbers(int accessor, std::size_t components) const;

  /// Unsigned integers. Throws base::Error, also for one that is not below `limit`.
  std::vector<std::uint32_t> indices(int accessor, std::size_t limit) const;

  /// Floats, so many of each element, that no sparse values replace.
  bool holds_floats(int accessor, std::size_t components) const;

  [[noreturn]] void fail(const std::string& what, int index, const std::string& problem) const;

private:
  // What the JSON says of one.
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

/// Which accessors have their bytes for themselves, so that these can be replaced where they lie. For the
/// document as it is when this is made; its accessors and views are those of the file. Borrows these.
class GltfSharing {
public:
  GltfSharing(const GltfJson& document, const GltfAccessors& accessors);

  /// How often the accessor is named, wherever that is.
  std::size_t uses(std::size_t accessor) const { return uses_[accessor]; }

  /// Floats that no other accessor or image shares a byte with.
  bool is_alone(int accessor, std::size_t components);

private:
  struct Bytes {
    std::size_t buffer, begin, end, stride;
    std::size_t accessor;      // that of an image: npos
    std::size_t furthest = 0;  // end of those of the buffer up to this one

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
