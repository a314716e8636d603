#include "mesh/formats/gltf_sharing.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace viete::mesh {

GltfSharing::GltfSharing(const GltfJson& document, const GltfAccessors& accessors) : accessors_(accessors) {
  count_uses(document);
  list_bytes(document);
}

void GltfSharing::count_uses(const GltfJson& document) {
  uses_.assign(document["accessors"].size(), 0);
  const auto use = [&](const GltfJson& value) {
    if (const auto accessor = count_of(value); accessor && *accessor < uses_.size()) ++uses_[*accessor];
  };
  const auto use_all = [&](const GltfJson& attributes) {
    if (!attributes.is_object()) return;
    for (const auto& [key, value] : attributes.items()) use(value);
  };
  for (const GltfJson& mesh : list_of(document, "meshes")) {
    for (const GltfJson& primitive : list_of(mesh, "primitives")) {
      use_all(member_of(primitive, "attributes"));
      use(member_of(primitive, "indices"));
      for (const GltfJson& target : list_of(primitive, "targets")) use_all(target);
    }
  }
  for (const GltfJson& node : list_of(document, "nodes"))
    use_all(member_of(member_of(member_of(node, "extensions"), "EXT_mesh_gpu_instancing"), "attributes"));
  for (const GltfJson& animation : list_of(document, "animations")) {
    for (const GltfJson& sampler : list_of(animation, "samplers")) use_all(sampler);
  }
  for (const GltfJson& skin : list_of(document, "skins")) use(member_of(skin, "inverseBindMatrices"));
}

// Which bytes somebody reads, by where they begin.
void GltfSharing::list_bytes(const GltfJson& document) {
  for (std::size_t i = 0; i < uses_.size(); ++i) {
    const auto place = uses_[i] > 0 ? place_if_sound(static_cast<int>(i)) : std::nullopt;
    if (place) bytes_.push_back(bytes_of(*place, i));
  }
  for (const GltfJson& image : list_of(document, "images"))
    list_image(element_of(document, "bufferViews", index_of(image, "bufferView")));
  std::sort(bytes_.begin(), bytes_.end());
  for (std::size_t i = 0; i < bytes_.size(); ++i) {
    const bool follows = i > 0 && bytes_[i - 1].buffer == bytes_[i].buffer;
    bytes_[i].furthest = std::max(bytes_[i].end, follows ? bytes_[i - 1].furthest : 0);
  }
}

void GltfSharing::list_image(const GltfJson& view) {
  const auto buffer = count_of(view, "buffer");
  if (!buffer) return;
  const std::size_t begin = count_of(view, "byteOffset").value_or(0);
  bytes_.push_back({*buffer, begin, begin + count_of(view, "byteLength").value_or(0), 0, std::string::npos});
}

GltfSharing::Bytes GltfSharing::bytes_of(const GltfPlace& p, std::size_t accessor) {
  return {p.buffer, p.offset, p.offset + (p.count - 1) * p.stride + p.size, p.stride, accessor};
}

// Neighbours in an interleaved view lie between each other's elements, not over them.
bool GltfSharing::interleaved(const GltfPlace& a, const Bytes& other) const {
  if (a.stride != other.stride) return false;
  const GltfPlace b = accessors_.place(static_cast<int>(other.accessor));
  const std::size_t from = a.offset % a.stride, to = b.offset % b.stride;
  return from + a.size <= to || to + b.size <= from;
}

bool GltfSharing::is_alone(int accessor, std::size_t components) {
  const auto index = static_cast<std::size_t>(accessor);
  const GltfPlace place = accessors_.place(accessor);
  if (!place.has_bytes || !accessors_.holds_floats(accessor, components)) return false;
  const Bytes mine = bytes_of(place, index);
  auto at = std::lower_bound(bytes_.begin(), bytes_.end(), Bytes{mine.buffer, mine.end, 0, 0, 0});
  while (at != bytes_.begin() && (--at)->buffer == mine.buffer && at->furthest > mine.begin) {
    if (++comparisons_ > 100'000'000) return false;  // a file made to take long
    if (at->accessor != index && at->end > mine.begin && !interleaved(place, *at)) return false;
  }
  return true;
}

std::optional<GltfPlace> GltfSharing::place_if_sound(int accessor) const {
  try {
    const GltfPlace place = accessors_.place(accessor);
    if (place.has_bytes) return place;
  } catch (const base::Error&) {  // what nobody reads need not be sound
  }
  return std::nullopt;
}

}  // namespace viete::mesh
