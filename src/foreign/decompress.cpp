// Decompresses glTF files with Draco and meshoptimizer, for the program viete-import.
#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#ifdef VIETE_DRACO
#include <draco/compression/decode.h>
#endif
#ifdef VIETE_MESHOPT
#include <meshoptimizer.h>
#endif

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/os.h"
#include "base/text.h"
#include "foreign/readers.h"
#include "formats/gltf_accessors.h"
#include "formats/gltf_morphs.h"
#include "formats/gltf_original.h"

namespace viete::foreign {

namespace {

using formats::count_of, formats::index_of, formats::list_of, formats::member_of, formats::text_of;
using Json = formats::GltfJson;

constexpr const char* draco_extension = "KHR_draco_mesh_compression";
constexpr const char* meshopt_extensions[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

[[noreturn]] void fail(const std::string& place, const std::string& problem) {
  throw base::Error(place, problem, "export without compression");
}

const Json& extension_of(const Json& json, const char* name) {
  return member_of(member_of(json, "extensions"), name);
}

void erase_extension(Json& json, const char* name) {
  if (!json.contains("extensions")) return;
  json["extensions"].erase(name);
  if (json["extensions"].empty()) json.erase("extensions");
}

#ifdef VIETE_MESHOPT

// The decoders require these conditions.
bool can_decode(const std::string& mode, const std::string& filter, std::size_t count, std::size_t stride) {
  if (mode == "INDICES" || (mode == "TRIANGLES" && count % 3 == 0))
    return (stride == 2 || stride == 4) && filter == "NONE";
  const bool fits = filter == "NONE" || filter == "EXPONENTIAL" || (filter == "OCTAHEDRAL" && stride == 4) ||
                    ((filter == "OCTAHEDRAL" || filter == "QUATERNION") && stride == 8);
  return mode == "ATTRIBUTES" && stride > 0 && stride <= 256 && stride % 4 == 0 && fits;
}

// Specification: EXT_meshopt_compression, https://github.com/KhronosGroup/glTF, 2021.
std::string decoded_by_meshopt(const std::string& place, const Json& packed, std::string_view bytes) {
  const std::size_t count = count_of(packed, "count").value_or(0),
                    stride = count_of(packed, "byteStride").value_or(0);
  const std::string mode = text_of(packed, "mode");
  const std::string filter = packed.contains("filter") ? text_of(packed, "filter") : "NONE";
  if (!can_decode(mode, filter, count, stride))
    fail(place, base::formatted("mode %.64s with filter %.64s cannot have %zu elements of %zu bytes",
                                mode.c_str(), filter.c_str(), count, stride));
  if (count > 1024 * bytes.size() / stride)  // no stream is shorter
    fail(place, base::formatted("%zu elements do not fit into %zu compressed bytes", count, bytes.size()));
  using Decode = int (*)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);
  const Decode decode = mode == "ATTRIBUTES"  ? Decode{meshopt_decodeVertexBuffer}
                        : mode == "TRIANGLES" ? Decode{meshopt_decodeIndexBuffer}
                                              : Decode{meshopt_decodeIndexSequence};
  std::string decoded(count * stride, '\0');
  if (decode(decoded.data(), count, stride, reinterpret_cast<const unsigned char*>(bytes.data()),
             bytes.size()) != 0)
    fail(place, "the compressed data is damaged or has a later version");
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), count, stride);
  return decoded;
}

#else

std::string decoded_by_meshopt(const std::string&, const Json&, std::string_view) {
  throw base::Error("", "viete-import was built without meshoptimizer",
                    "install libmeshoptimizer-dev and build Viete again, or export without compression");
}

#endif

// The decoders allocate memory for the counts of the file before they decode. Usual meshes need less.
void limit_memory(const formats::GltfFile& file) {
  double bytes = 2e9;
  for (const formats::GltfBuffer& buffer : file.buffers)
    bytes += 512.0 * static_cast<double>(buffer.bytes.size());
  base::os::limit_process(std::min(bytes, base::os::total_memory().value_or(bytes)), most_seconds);
}

class Decompressor {
public:
  explicit Decompressor(formats::GltfFile file) : file_(std::move(file)), document_(file_.document) {
    constexpr std::size_t most_overlapping = 8;  // for example, attributes of the same vertices
    for (const formats::GltfBuffer& buffer : file_.buffers) left_ += most_overlapping * buffer.bytes.size();
  }

  std::string glb() {
    find_draco();
    take_views();
    decode_primitives();
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) remove_names(key);
    document_["buffers"] = {{{"byteLength", bytes_.size()}}};
    if (bytes_.empty()) document_.erase("buffers");
    return formats::written_text([&](formats::TextWriter& out) {
      formats::write_glb_chunks(document_.dump(), bytes_, file_.other_chunks, out);
    });
  }

private:
  struct Primitive {
    std::string place;
    Json& json;
  };

  std::string place(const char* element, std::size_t index) const {
    return file_.name + ": " + element + std::to_string(index);
  }

  // Returns the bytes of a buffer view. The extensions for views have the same members.
  std::string_view bytes_of(const std::string& place, const Json& view) {
    const auto buffer = count_of(view, "buffer"), length = count_of(view, "byteLength");
    const std::uint64_t begin = count_of(view, "byteOffset").value_or(0);
    if (!buffer || *buffer >= file_.buffers.size() || !length)
      fail(place, "has no byteLength or refers to a buffer that does not exist");
    const std::string_view bytes = file_.buffers[*buffer].bytes;
    if (begin > bytes.size() || *length > bytes.size() - begin)
      fail(place, "reaches past the " + std::to_string(bytes.size()) + " bytes of its buffer");
    if (*length > left_) fail(place, "overlaps too many other buffer views");
    left_ -= *length;
    return bytes.substr(begin, *length);
  }

  // Several primitives can be parts of the same compressed data.
  void find_draco() {
    const std::size_t meshes = list_of(document_, "meshes").size(),
                      views = list_of(document_, "bufferViews").size();
    for (std::size_t m = 0; m < meshes; ++m) {
      Json& primitives = document_["meshes"][m]["primitives"];
      for (std::size_t p = 0; p < primitives.size(); ++p) {
        const Json& packed = extension_of(primitives[p], draco_extension);
        if (packed.is_null()) continue;
        const std::string at = place("mesh ", m) + ", primitive " + std::to_string(p);
        const auto view = count_of(packed, "bufferView");
        if (!view || *view >= views) fail(at, "its Draco data is in no buffer view of the file");
        by_draco_view_[*view].push_back({at, primitives[p]});
      }
    }
  }

  // Copies uncompressed views and decodes compressed ones, except those of Draco.
  void take_views() {
    for (std::size_t i = 0; i < list_of(document_, "bufferViews").size(); ++i) {
      if (by_draco_view_.contains(i)) continue;
      Json& view = document_["bufferViews"][i];
      const std::string at = place("buffer view ", i);
      const auto* const name = std::ranges::find_if(
          meshopt_extensions, [&](const char* n) { return !extension_of(view, n).is_null(); });
      if (name == std::end(meshopt_extensions)) {
        put_bytes(view, bytes_of(at, view));
        continue;
      }
      const Json packed = extension_of(view, *name);
      put_bytes(view, decoded_by_meshopt(at, packed, bytes_of(at, packed)));
      for (const char* extension : meshopt_extensions) erase_extension(view, extension);
    }
  }

  // Appends the bytes to the new binary chunk.
  void put_bytes(Json& view, std::string_view bytes) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    view["buffer"] = 0;
    view["byteOffset"] = bytes_.size();
    view["byteLength"] = bytes.size();
    bytes_ += bytes;
  }

  void remove_names(const char* key) {
    if (list_of(document_, key).empty()) return;
    std::erase_if(document_[key].get_ref<Json::array_t&>(), [](const Json& name) {
      return name.is_string() && formats::compresses_gltf(name.get<std::string>());
    });
    if (document_[key].empty()) document_.erase(key);
  }

#ifdef VIETE_DRACO
  void decode_primitives() {
    for (const auto& [view, primitives] : by_draco_view_) {
      const std::string& place = primitives.front().place;
      const std::string_view bytes = bytes_of(place, document_["bufferViews"][view]);
      draco::DecoderBuffer buffer;
      buffer.Init(bytes.data(), bytes.size());
      const auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
      if (!mesh.ok())
        fail(place, base::formatted("its Draco data is damaged (%s)", mesh.status().error_msg()));
      if (mesh.value()->num_points() == 0) fail(place, "its Draco data has no vertices");
      next_view_ = view;
      for (const Primitive& primitive : primitives) replace(primitive, view, *mesh.value());
    }
  }

  // Specification: KHR_draco_mesh_compression, https://github.com/KhronosGroup/glTF, 2018. The decoder
  // unpacks strips. The number of decoded vertices replaces the accessor's count.
  void replace(const Primitive& primitive, std::size_t view, const draco::Mesh& mesh) {
    Json& json = primitive.json;
    const Json ids = member_of(extension_of(json, draco_extension), "attributes");
    json["indices"] =
        filled(index_of(json, "indices"), view, no_id, [&](Json& to) { put_indices(mesh, to); });
    for (const auto& [name, id] : ids.items()) {
      const std::string at = primitive.place + ", " + base::printable(name, 64);
      const int accessor = formats::accessor_of(json, name.c_str());
      const auto number = count_of(id);
      const draco::PointAttribute* const from =
          number && *number < no_id ? mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(*number))
                                    : nullptr;
      if (accessor < 0 || !from) fail(at, "its accessor or its Draco data is missing");
      json["attributes"][name] =
          filled(accessor, view, *number, [&](Json& to) { put_attribute(at, mesh, *from, to); });
    }
    json["mode"] = formats::gltf_triangles;
    erase_extension(json, draco_extension);
  }

  // Returns the index of an accessor with decoded values. An accessor that has data, for programs that do not
  // decompress, keeps it, because uncompressed primitives can use it too.
  template <class Fill>
  std::size_t filled(int accessor, std::size_t view, std::uint64_t id, const Fill& fill) {
    const auto [at, is_new] = filled_.try_emplace({accessor, view, id}, accessor);
    if (!is_new) return at->second;
    Json& all = document_["accessors"];
    Json json = accessor < 0 ? Json{{"type", "SCALAR"}} : all[at->second];
    if (accessor < 0 || json.contains("bufferView") || json.contains("sparse")) {
      at->second = all.size();
      all.push_back(nullptr);
    }
    for (const char* key : {"byteOffset", "sparse"}) json.erase(key);
    fill(json);
    all[at->second] = std::move(json);
    return at->second;
  }

  void put_indices(const draco::Mesh& mesh, Json& accessor) {
    if (index_of(accessor, "componentType") != formats::gltf_unsigned_short || mesh.num_points() > 65535)
      accessor["componentType"] = formats::gltf_unsigned_int;
    for (const char* key : {"min", "max"}) accessor.erase(key);
    put(accessor, 3 * std::size_t{mesh.num_faces()}, 1, formats::gltf_element_buffer,
        [&](std::size_t i, auto* to) {
          const auto point = mesh.face(draco::FaceIndex(static_cast<std::uint32_t>(i / 3)))[i % 3].value();
          *to = static_cast<std::remove_pointer_t<decltype(to)>>(point);
        });
  }

  void put_attribute(const std::string& place, const draco::Mesh& mesh, const draco::PointAttribute& from,
                     Json& accessor) {
    const std::string type = text_of(accessor, "type");
    const std::size_t components = formats::gltf_component_count(type);
    if (components != from.num_components() ||
        !formats::gltf_number_type(index_of(accessor, "componentType")))
      fail(place, base::formatted("its Draco data has %d components, its accessor is %.16s",
                                  from.num_components(), type.c_str()));
    put(accessor, mesh.num_points(), components, formats::gltf_array_buffer, [&](std::size_t i, auto* to) {
      const auto value = from.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
      if (!from.ConvertValue(value, static_cast<std::int8_t>(components), to))
        fail(place, "a value of its Draco data does not fit the type of its accessor");
    });
  }

  // get(i, to) stores the components of element i. Elements of vertices begin at multiples of four bytes.
  template <class Get>
  void put(Json& accessor, std::size_t count, std::size_t components, int target, const Get& get) {
    base::with_type(*formats::gltf_number_type(index_of(accessor, "componentType")), [&](auto zero) {
      using Number = decltype(zero);
      const bool aligned = target == formats::gltf_array_buffer && sizeof zero < 4;
      const std::size_t step = aligned ? (components * sizeof zero + 3) / 4 * 4 / sizeof zero : components;
      std::vector<Number> values(step * count);
      for (std::size_t i = 0; i < count; ++i) get(i, &values[step * i]);
      accessor["count"] = count;
      Json& views = document_["bufferViews"];
      if (next_view_ == views.size()) views.push_back(nullptr);
      Json& view = views[next_view_] = {{"target", target}};
      accessor["bufferView"] = std::exchange(next_view_, views.size());
      put_bytes(view, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof zero});
      if (step != components) view["byteStride"] = step * sizeof zero;
      if constexpr (std::is_same_v<Number, float>)
        if (accessor.contains("min")) formats::set_gltf_bounds(accessor, values, components);
    });
  }

  static constexpr std::uint64_t no_id = std::numeric_limits<std::uint32_t>::max();  // for indices
  std::map<std::tuple<int, std::size_t, std::uint64_t>, std::size_t> filled_;
#else
  void decode_primitives() {
    if (by_draco_view_.empty()) return;
    throw base::Error("", "viete-import was built without Draco",
                      "install libdraco-dev and build Viete again, or export without compression");
  }
#endif

  formats::GltfFile file_;
  Json& document_;
  std::map<std::size_t, std::vector<Primitive>> by_draco_view_;
  std::size_t left_ = 0;       // bytes that may still be copied or decoded
  std::string bytes_;          // the new binary chunk
  std::size_t next_view_ = 0;  // for decoded data: the view of the compressed data, then new views
};

}  // namespace

std::string decompressed_gltf(const std::filesystem::path& file) {
  const base::FileBytes bytes(file);
  formats::Source source{file.string(), base::extension_of(file), bytes.view()};
  source.folder = base::folder_of(file);
  formats::GltfFile taken = formats::take_apart(source, true);
  limit_memory(taken);
  return Decompressor(std::move(taken)).glb();
}

}  // namespace viete::foreign
