// Which accessors of a glTF file have their bytes for themselves, so that these can be replaced where they
// lie.
#pragma once

#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

#include "mesh/formats/gltf_accessors.h"
#include "mesh/formats/gltf_json.h"

namespace viete::mesh {

/// Of the document as it is when this is made; its accessors and views are those of the file. Borrows these.
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
