#include "formats/gltf_accessors.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "base/byte_order.h"
#include "base/error.h"

namespace viete::formats {

namespace {

// The index is the component type minus gltf_byte. glTF does not use the entry int32.
constexpr base::NumberType number_types[] = {
    base::NumberType::int8,  base::NumberType::uint8,  base::NumberType::int16,  base::NumberType::uint16,
    base::NumberType::int32, base::NumberType::uint32, base::NumberType::float32};

std::size_t component_size(int type) {
  const auto number = gltf_number_type(type);
  return number ? size_of(*number) : 0;
}

bool is_unsigned(int type) {
  return type == gltf_unsigned_byte || type == gltf_unsigned_short || type == gltf_unsigned_int;
}

double number_at(const char* at, int type, bool normalized) {
  return with_type(number_types[type - gltf_byte], [&](auto number) {
    using Number = decltype(number);
    const double value = static_cast<double>(base::number_of_bytes<Number>(at));
    if (!normalized || !std::is_integral_v<Number> || sizeof number > 2) return value;
    return std::max(value / static_cast<double>(std::numeric_limits<Number>::max()), -1.0);
  });
}

}  // namespace

std::optional<base::NumberType> gltf_number_type(int component_type) {
  const bool known = component_type >= gltf_byte && component_type <= gltf_float &&
                     component_type != gltf_unsigned_short + 1;
  return known ? std::optional(number_types[component_type - gltf_byte]) : std::nullopt;
}

std::size_t gltf_component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  const bool vector = type == "VEC2" || type == "VEC3" || type == "VEC4";
  return vector ? static_cast<std::size_t>(type[3] - '0') : 0;
}

void GltfAccessors::fail(const std::string& what, int index, const std::string& problem) const {
  throw base::Error(file_.name + ": " + what + " " + std::to_string(index), problem,
                    "export the model again");
}

std::size_t GltfAccessors::Accessor::size() const {
  return component_size(component) * components;
}

GltfAccessors::Accessor GltfAccessors::at(int accessor) const {
  const GltfJson& json = element_of(file_.document, "accessors", accessor);
  if (json.is_null())
    fail("accessor", accessor,
         "does not exist, the file has " + std::to_string(list_of(file_.document, "accessors").size()) +
             " accessors, counted from 0");
  const GltfJson& normalized = member_of(json, "normalized");
  return {index_of(json, "componentType"),
          gltf_component_count(text_of(json, "type")),
          count_of(json, "count").value_or(0),
          normalized.is_boolean() && normalized.get<bool>(),
          json,
          member_of(json, "sparse")};
}

GltfPlace GltfAccessors::of_view(int accessor, const GltfJson& data, std::size_t count,
                                 std::size_t size) const {
  const int view = index_of(data, "bufferView");
  const GltfJson& v = element_of(file_.document, "bufferViews", view);
  if (v.is_null())
    fail("accessor", accessor, "refers to buffer view " + std::to_string(view) + ", which does not exist");
  const auto number = [](const GltfJson& json, const char* key) { return count_of(json, key).value_or(0); };
  const std::size_t buffer = count_of(v, "buffer").value_or(file_.buffers.size());
  if (buffer >= file_.buffers.size())
    fail("buffer view", view, "refers to buffer " + std::to_string(buffer) + ", which does not exist");
  const std::size_t all = file_.buffers[buffer].bytes.size(), begin = number(v, "byteOffset"),
                    length = number(v, "byteLength"), offset = number(data, "byteOffset");
  if (begin > all || length > all - begin)
    fail("buffer view", view, "reaches past the " + std::to_string(all) + " bytes of its buffer");
  const std::size_t given = number(v, "byteStride"), stride = given > 0 ? given : size;
  if (stride < size || stride > 4096)
    fail(
        "buffer view", view,
        "has a byteStride of " + std::to_string(stride) + " instead of " + std::to_string(size) + " to 4096");
  const bool fits =
      offset <= length && size <= length - offset && (count - 1) <= (length - offset - size) / stride;
  if (!fits)
    fail("accessor", accessor,
         std::to_string(count) + " elements do not fit into the " + std::to_string(length) +
             " bytes of its buffer view");
  return {buffer, begin + offset, stride, count, size, true};
}

bool GltfAccessors::holds_floats(int accessor, std::size_t components) const {
  const Accessor a = at(accessor);
  return a.sparse.is_null() && a.component == gltf_float && a.components == components;
}

GltfPlace GltfAccessors::place(int accessor) const {
  const Accessor a = at(accessor);
  const std::size_t size = a.size();
  if (size == 0) fail("accessor", accessor, "has an unknown type");
  if (a.count == 0) fail("accessor", accessor, "has no elements");
  if (a.json.contains("bufferView")) return of_view(accessor, a.json, a.count, size);
  std::size_t bytes = 0;
  for (const GltfBuffer& buffer : file_.buffers) bytes += buffer.bytes.size();
  if (a.sparse.is_null() || a.count > bytes) fail("accessor", accessor, "has no data");
  return {0, 0, size, a.count, size, false};
}

std::vector<double> GltfAccessors::numbers(int accessor, std::size_t components) const {
  const Accessor a = at(accessor);
  if (a.components < components)
    fail("accessor", accessor, "has fewer than " + std::to_string(components) + " components");
  const GltfPlace from = place(accessor);
  std::vector<double> numbers(from.count * components, 0);
  const std::size_t step = component_size(a.component);
  for (std::size_t i = 0; from.has_bytes && i < from.count; ++i) {
    const char* element = bytes(from) + i * from.stride;
    for (std::size_t k = 0; k < components; ++k)
      numbers[i * components + k] = number_at(element + k * step, a.component, a.normalized);
  }
  if (!a.sparse.is_null()) put_sparse(accessor, a, components, numbers);
  return numbers;
}

void GltfAccessors::put_sparse(int index, const Accessor& a, std::size_t components,
                               std::vector<double>& numbers) const {
  const std::size_t count = count_of(a.sparse, "count").value_or(0);
  if (count == 0 || count > a.count)
    fail("accessor", index,
         "has " + std::to_string(count) + " sparse values for " + std::to_string(a.count) + " elements");
  const GltfJson& indices = member_of(a.sparse, "indices");
  const int type = index_of(indices, "componentType");
  if (!is_unsigned(type)) fail("accessor", index, "has sparse indices that are not unsigned integers");
  const GltfPlace where = of_view(index, indices, count, component_size(type));
  const GltfPlace what = of_view(index, member_of(a.sparse, "values"), count, a.size());
  const std::size_t step = component_size(a.component);
  for (std::size_t i = 0; i < count; ++i) {
    const double target = number_at(bytes(where) + i * where.stride, type, false);
    if (target >= static_cast<double>(a.count))
      fail("accessor", index, "has a sparse index that is too large");
    const char* element = bytes(what) + i * what.stride;
    for (std::size_t k = 0; k < components; ++k)
      numbers[static_cast<std::size_t>(target) * components + k] =
          number_at(element + k * step, a.component, a.normalized);
  }
}

std::vector<std::uint32_t> GltfAccessors::indices(int accessor, std::size_t limit) const {
  const Accessor a = at(accessor);
  if (!is_unsigned(a.component) || a.components != 1) fail("accessor", accessor, "does not contain indices");
  const std::vector<double> numbers = this->numbers(accessor, 1);
  std::vector<std::uint32_t> indices(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] >= static_cast<double>(limit))
      fail("accessor", accessor,
           "has index " + std::to_string(static_cast<std::uint64_t>(numbers[i])) + ", the primitive has " +
               std::to_string(limit) + " vertices");
    indices[i] = static_cast<std::uint32_t>(numbers[i]);
  }
  return indices;
}

GltfSharing::GltfSharing(const GltfJson& document, const GltfAccessors& accessors) : accessors_(accessors) {
  count_uses(document);
  list_bytes(document);
}

bool GltfSharing::is_alone(int accessor, std::size_t components) {
  const auto index = static_cast<std::size_t>(accessor);
  const GltfPlace place = accessors_.place(accessor);
  if (!place.has_bytes || !accessors_.holds_floats(accessor, components)) return false;
  const Bytes mine = bytes_of(place, index);
  auto at = std::lower_bound(bytes_.begin(), bytes_.end(), Bytes{mine.buffer, mine.end, 0, 0, 0});
  while (at != bytes_.begin() && (--at)->buffer == mine.buffer && at->furthest > mine.begin) {
    if (++comparisons_ > 100'000'000) return false;  // limits the time for malicious files
    if (at->accessor != index && at->end > mine.begin && !interleaved(place, *at)) return false;
  }
  return true;
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
  for (const GltfJson& mesh : list_of(document, "meshes"))
    for (const GltfJson& primitive : list_of(mesh, "primitives")) {
      use_all(member_of(primitive, "attributes"));
      use(member_of(primitive, "indices"));
      for (const GltfJson& target : list_of(primitive, "targets")) use_all(target);
    }
  for (const GltfJson& node : list_of(document, "nodes"))
    use_all(member_of(member_of(member_of(node, "extensions"), "EXT_mesh_gpu_instancing"), "attributes"));
  for (const GltfJson& animation : list_of(document, "animations"))
    for (const GltfJson& sampler : list_of(animation, "samplers")) use_all(sampler);
  for (const GltfJson& skin : list_of(document, "skins")) use(member_of(skin, "inverseBindMatrices"));
}

void GltfSharing::list_bytes(const GltfJson& document) {
  for (std::size_t i = 0; i < uses_.size(); ++i) {
    if (uses_[i] == 0) continue;
    try {
      const GltfPlace place = accessors_.place(static_cast<int>(i));
      if (place.has_bytes) bytes_.push_back(bytes_of(place, i));
    } catch (const base::Error&) {  // skips invalid accessors, which the surface does not use
    }
  }
  for (const GltfJson& image : list_of(document, "images")) {
    const GltfJson& view = element_of(document, "bufferViews", index_of(image, "bufferView"));
    const auto buffer = count_of(view, "buffer");
    const std::size_t begin = count_of(view, "byteOffset").value_or(0);
    const std::size_t end = begin + count_of(view, "byteLength").value_or(0);
    if (buffer) bytes_.push_back({*buffer, begin, end, 0, std::string::npos});
  }
  std::sort(bytes_.begin(), bytes_.end());
  for (std::size_t i = 0; i < bytes_.size(); ++i) {
    const bool follows = i > 0 && bytes_[i - 1].buffer == bytes_[i].buffer;
    bytes_[i].furthest = std::max(bytes_[i].end, follows ? bytes_[i - 1].furthest : 0);
  }
}

GltfSharing::Bytes GltfSharing::bytes_of(const GltfPlace& p, std::size_t accessor) {
  return {p.buffer, p.offset, p.offset + (p.count - 1) * p.stride + p.size, p.stride, accessor};
}

// Returns true if the elements of both accessors alternate without overlap. Both must be in one buffer.
bool GltfSharing::interleaved(const GltfPlace& a, const Bytes& other) const {
  if (a.stride != other.stride) return false;
  const GltfPlace b = accessors_.place(static_cast<int>(other.accessor));
  const std::size_t from = a.offset % a.stride, to = b.offset % b.stride;
  return from + a.size <= to || to + b.size <= from;
}

}  // namespace viete::formats
