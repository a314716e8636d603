#include "mesh/formats/gltf_accessors.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/error.h"

namespace viete::mesh {

namespace {

std::size_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return 4;
    default: return 0;
  }
}

// Matrices are nothing that a surface is made of.
std::size_t component_count(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR: return 1;
    case TINYGLTF_TYPE_VEC2: return 2;
    case TINYGLTF_TYPE_VEC3: return 3;
    case TINYGLTF_TYPE_VEC4: return 4;
    default: return 0;
  }
}

template <class T>
double read_number(const unsigned char* at, bool normalized) {
  T value;
  std::memcpy(&value, at, sizeof value);
  if constexpr (std::numeric_limits<T>::is_integer) {
    constexpr double largest = static_cast<double>(std::numeric_limits<T>::max());
    if (normalized) return std::max(static_cast<double>(value) / largest, -1.0);
  }
  return static_cast<double>(value);
}

double number_at(const unsigned char* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return read_number<std::int8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return read_number<std::uint8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return read_number<std::int16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return read_number<std::uint16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return read_number<std::uint32_t>(at, false);
    default: return read_number<float>(at, false);
  }
}

}  // namespace

std::shared_ptr<const tinygltf::Model> parse_gltf(const GltfFile& file) {
  auto model = std::make_shared<tinygltf::Model>();
  tinygltf::TinyGLTF loader;
  std::string problem, warning;
  if (file.loadable.size() >= std::numeric_limits<unsigned>::max())
    throw base::Error(file.name, "its JSON has more than 4 GB", "export it as GLB");
  const auto size = static_cast<unsigned>(file.loadable.size());
  if (loader.LoadASCIIFromString(model.get(), &problem, &warning, file.loadable.data(), size, ""))
    return model;
  const std::string line = problem.substr(0, std::min<std::size_t>(problem.find('\n'), 200));
  throw base::Error(file.name, "not sound glTF: " + line, "export the model again");
}

void GltfAccessors::fail(const std::string& what, int index, const std::string& problem) const {
  throw base::Error(file_.name + ": " + what + " " + std::to_string(index), problem,
                    "export the model again");
}

const tinygltf::Accessor& GltfAccessors::at(int accessor) const {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= model_.accessors.size())
    fail("accessor", accessor, "is not there, the file has " + std::to_string(model_.accessors.size()));
  return model_.accessors[static_cast<std::size_t>(accessor)];
}

GltfPlace GltfAccessors::of_view(int accessor, int view, std::size_t offset, std::size_t count,
                                 std::size_t size) const {
  if (view < 0 || static_cast<std::size_t>(view) >= model_.bufferViews.size())
    fail("accessor", accessor, "refers to buffer view " + std::to_string(view) + ", which is not there");
  const tinygltf::BufferView& v = model_.bufferViews[static_cast<std::size_t>(view)];
  if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= file_.buffers.size())
    fail("buffer view", view, "refers to buffer " + std::to_string(v.buffer) + ", which is not there");
  const auto buffer = static_cast<std::size_t>(v.buffer);
  const std::size_t all = file_.buffers[buffer].bytes.size();
  if (v.byteOffset > all || v.byteLength > all - v.byteOffset)
    fail("buffer view", view, "reaches past the " + std::to_string(all) + " bytes of its buffer");
  const std::size_t stride = v.byteStride > 0 ? v.byteStride : size;
  if (stride < size || stride > 4096) fail("buffer view", view, "has a stride of " + std::to_string(stride));
  const bool fits = offset <= v.byteLength && size <= v.byteLength - offset &&
                    (count - 1) <= (v.byteLength - offset - size) / stride;
  if (!fits)
    fail("accessor", accessor,
         std::to_string(count) + " elements do not fit into the " + std::to_string(v.byteLength) +
             " bytes of its buffer view");
  return {buffer, v.byteOffset + offset, stride, count, size, true};
}

std::size_t GltfAccessors::components(int accessor) const {
  return component_count(at(accessor).type);
}

GltfPlace GltfAccessors::place(int accessor) const {
  const tinygltf::Accessor& a = at(accessor);
  const std::size_t size = component_size(a.componentType) * component_count(a.type);
  if (size == 0) fail("accessor", accessor, "has a type that is not one of glTF");
  if (a.count == 0) fail("accessor", accessor, "has no elements");
  if (a.bufferView >= 0) return of_view(accessor, a.bufferView, a.byteOffset, a.count, size);
  std::size_t bytes = 0;
  for (const GltfBuffer& buffer : file_.buffers) bytes += buffer.bytes.size();
  if (!a.sparse.isSparse || a.count > bytes) fail("accessor", accessor, "has no data");
  return {0, 0, size, a.count, size, false};
}

std::vector<double> GltfAccessors::numbers(int accessor, std::size_t components) const {
  const tinygltf::Accessor& a = at(accessor);
  if (component_count(a.type) < components)
    fail("accessor", accessor, "has fewer than " + std::to_string(components) + " components");
  const GltfPlace from = place(accessor);
  std::vector<double> numbers(from.count * components, 0);
  const std::size_t step = component_size(a.componentType);
  for (std::size_t i = 0; from.has_bytes && i < from.count; ++i) {
    const unsigned char* element = bytes(from) + i * from.stride;
    for (std::size_t k = 0; k < components; ++k)
      numbers[i * components + k] = number_at(element + k * step, a.componentType, a.normalized);
  }
  if (a.sparse.isSparse) put_sparse(accessor, a, components, numbers);
  return numbers;
}

void GltfAccessors::put_sparse(int index, const tinygltf::Accessor& a, std::size_t components,
                               std::vector<double>& numbers) const {
  const auto& sparse = a.sparse;
  if (sparse.count <= 0 || static_cast<std::size_t>(sparse.count) > a.count)
    fail("accessor", index, "has a sparse count of " + std::to_string(sparse.count));
  const int type = sparse.indices.componentType;
  const std::size_t step = component_size(a.componentType), index_size = component_size(type);
  const bool has_integers = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                            type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                            type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (!has_integers) fail("accessor", index, "has sparse indices that are no integers");
  const auto count = static_cast<std::size_t>(sparse.count);
  const GltfPlace where = of_view(index, sparse.indices.bufferView,
                                  static_cast<std::size_t>(sparse.indices.byteOffset), count, index_size);
  const GltfPlace what =
      of_view(index, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
              step * component_count(a.type));
  for (std::size_t i = 0; i < count; ++i) {
    const double target = number_at(bytes(where) + i * where.stride, type, false);
    if (target >= static_cast<double>(a.count))
      fail("accessor", index, "has a sparse index past its elements");
    const unsigned char* element = bytes(what) + i * what.stride;
    for (std::size_t k = 0; k < components; ++k)
      numbers[static_cast<std::size_t>(target) * components + k] =
          number_at(element + k * step, a.componentType, a.normalized);
  }
}

std::vector<std::uint32_t> GltfAccessors::indices(int accessor, std::size_t limit) const {
  const tinygltf::Accessor& a = at(accessor);
  const int type = a.componentType;
  const bool is_integer = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                          type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (!is_integer || a.type != TINYGLTF_TYPE_SCALAR) fail("accessor", accessor, "holds no indices");
  const std::vector<double> numbers = this->numbers(accessor, 1);
  std::vector<std::uint32_t> indices(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] >= static_cast<double>(limit))
      fail("accessor", accessor,
           "index " + std::to_string(static_cast<std::uint64_t>(numbers[i])) + " refers past the " +
               std::to_string(limit) + " vertices of its primitive");
    indices[i] = static_cast<std::uint32_t>(numbers[i]);
  }
  return indices;
}

}  // namespace viete::mesh
