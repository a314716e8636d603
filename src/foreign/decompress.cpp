#include "foreign/decompress.h"

#include <cstring>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#ifdef VIETE_DRACO
#include <draco/compression/decode.h>
#endif
#ifdef VIETE_MESHOPT
#include <meshoptimizer.h>
#endif

#include "base/error.h"
#include "base/os.h"
#include "base/text.h"
#include "formats/gltf_accessors.h"
#include "formats/gltf_morphs.h"
#include "formats/gltf_output.h"

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

struct Packed {
  std::size_t count, stride;
  std::string mode, filter;
  std::string_view bytes;
};

// Specification: EXT_meshopt_compression, https://github.com/KhronosGroup/glTF, 2021. The decoders require
// these conditions. A byte of their streams contains at most 1024 bytes.
void check(const std::string& place, const Packed& p) {
  const bool attributes = p.mode == "ATTRIBUTES", triangles = p.mode == "TRIANGLES";
  if (!attributes && !triangles && p.mode != "INDICES")
    fail(place, "has the unknown mode " + p.mode.substr(0, 64));
  const bool fits = attributes ? p.stride > 0 && p.stride <= 256 && p.stride % 4 == 0
                               : (p.stride == 2 || p.stride == 4) && (!triangles || p.count % 3 == 0);
  const bool filtered = p.filter == "NONE" || (attributes && p.filter == "EXPONENTIAL") ||
                        (p.filter == "OCTAHEDRAL" && attributes && (p.stride == 4 || p.stride == 8)) ||
                        (p.filter == "QUATERNION" && attributes && p.stride == 8);
  if (!fits || !filtered)
    fail(place, base::formatted("mode %.64s with filter %.64s cannot have %zu elements of %zu bytes",
                                p.mode.c_str(), p.filter.c_str(), p.count, p.stride));
  if (p.count > 1024 * p.bytes.size() / p.stride)
    fail(place,
         base::formatted("%zu elements do not fit into %zu compressed bytes", p.count, p.bytes.size()));
}

std::string decoded_by_meshopt(const std::string& place, const Packed& p) {
  check(place, p);
  std::string decoded(p.count * p.stride, '\0');
  using Decode = int (*)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);
  const Decode decode = p.mode == "ATTRIBUTES"  ? Decode{meshopt_decodeVertexBuffer}
                        : p.mode == "TRIANGLES" ? Decode{meshopt_decodeIndexBuffer}
                                                : Decode{meshopt_decodeIndexSequence};
  const auto* const bytes = reinterpret_cast<const unsigned char*>(p.bytes.data());
  if (decode(decoded.data(), p.count, p.stride, bytes, p.bytes.size()) != 0)
    fail(place, "the compressed data is damaged or has a later version");
  if (p.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), p.count, p.stride);
  if (p.filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), p.count, p.stride);
  if (p.filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), p.count, p.stride);
  return decoded;
}

#endif

// The decoders allocate memory for the counts of the file before they decode. Usual meshes need less than
// this.
void limit_memory(const formats::GltfFile& file) {
  double bytes = 2e9;
  for (const formats::GltfBuffer& buffer : file.buffers)
    bytes += 512.0 * static_cast<double>(buffer.bytes.size());
  base::os::limit_process(std::min(bytes, base::os::total_memory().value_or(bytes)), most_seconds);
}

class Decompressor {
public:
  explicit Decompressor(formats::GltfFile file) : file_(std::move(file)), document_(file_.document) {}

  std::string glb() {
    find_draco();
    keep_uncompressed();
    decode_views();
    decode_primitives();
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) remove_names(key);
    document_["buffers"] = {{{"byteLength", bytes_.size()}}};
    if (bytes_.empty()) document_.erase("buffers");
    std::string glb;
    formats::TextWriter out([&](std::string_view portion) { glb += portion; });
    formats::write_glb_chunks(document_.dump(), bytes_, file_.other_chunks, out);
    out.finish();
    return glb;
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
  std::string_view bytes_of(const std::string& place, const Json& view) const {
    const auto buffer = count_of(view, "buffer"), length = count_of(view, "byteLength");
    const std::uint64_t begin = count_of(view, "byteOffset").value_or(0);
    if (!buffer || *buffer >= file_.buffers.size() || !length)
      fail(place, "has no byteLength or refers to a buffer that does not exist");
    const std::string_view bytes = file_.buffers[*buffer].bytes;
    if (begin > bytes.size() || *length > bytes.size() - begin)
      fail(place, "reaches past the " + std::to_string(bytes.size()) + " bytes of its buffer");
    return bytes.substr(begin, *length);
  }

  static const char* meshopt_extension_of(const Json& view) {
    for (const char* name : meshopt_extensions)
      if (!extension_of(view, name).is_null()) return name;
    return nullptr;
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

  // Copies the bytes of all uncompressed views. Bytes of overlapping views are copied once.
  void keep_uncompressed() {
    struct View {
      const char *begin, *end;
      std::size_t index;
    };
    std::vector<View> views;
    for (std::size_t i = 0; i < list_of(document_, "bufferViews").size(); ++i) {
      if (by_draco_view_.contains(i) || meshopt_extension_of(document_["bufferViews"][i])) continue;
      const std::string_view bytes = bytes_of(place("buffer view ", i), document_["bufferViews"][i]);
      views.push_back({bytes.data(), bytes.data() + bytes.size(), i});
    }
    std::ranges::sort(views, std::ranges::less(), &View::begin);
    const char *first = nullptr, *end = nullptr;  // the last copied range
    std::size_t first_at = 0;
    for (const View& view : views) {
      Json& json = document_["bufferViews"][view.index];
      if (!end || view.begin >= end) {
        while (bytes_.size() % 4 != count_of(json, "byteOffset").value_or(0) % 4) bytes_ += '\0';
        first = end = view.begin;
        first_at = bytes_.size();
      }
      if (view.end > end) bytes_.append(end, view.end);
      end = std::max(end, view.end);
      json["buffer"] = 0;
      json["byteOffset"] = first_at + static_cast<std::size_t>(view.begin - first);
    }
  }

  void decode_views() {
    for (std::size_t i = 0; i < list_of(document_, "bufferViews").size(); ++i) {
      Json view = document_["bufferViews"][i];
      const char* const extension = meshopt_extension_of(view);
      if (!extension) continue;
      const std::string decoded = decoded_view(place("buffer view ", i), extension_of(view, extension));
      for (const char* name : meshopt_extensions) erase_extension(view, name);
      free_view_ = i;
      view.update(document_["bufferViews"][add_view(decoded.data(), decoded.size())]);
      document_["bufferViews"][i] = std::move(view);
    }
  }

  // Adds a view of decoded data. Replaces a view of compressed data that is no longer needed.
  std::size_t add_view(const void* data, std::size_t size) {
    const std::size_t added = formats::add_gltf_view(document_, bytes_, data, size);
    const std::size_t view = std::exchange(free_view_, std::nullopt).value_or(added);
    Json& views = document_["bufferViews"];
    if (view == added) return added;
    views[view] = std::move(views.back());
    views.erase(added);
    return view;
  }

  void remove_names(const char* key) {
    if (!document_.contains(key) || !document_[key].is_array()) return;
    Json names = Json::array();
    for (const Json& name : document_[key])
      if (!name.is_string() || !formats::compresses_gltf(name.get<std::string>())) names.push_back(name);
    document_[key] = std::move(names);
    if (document_[key].empty()) document_.erase(key);
  }

#ifdef VIETE_MESHOPT
  std::string decoded_view(const std::string& place, const Json& packed) const {
    const std::string filter = text_of(packed, "filter");
    return decoded_by_meshopt(
        place, {count_of(packed, "count").value_or(0), count_of(packed, "byteStride").value_or(0),
                text_of(packed, "mode"), filter.empty() ? "NONE" : filter, bytes_of(place, packed)});
  }
#else
  std::string decoded_view(const std::string&, const Json&) const {
    throw base::Error(file_.name,
                      "viete-import was built without meshoptimizer, which decompresses its meshes",
                      "install libmeshoptimizer-dev and build Viete again, or export without compression");
  }
#endif

#ifdef VIETE_DRACO
  void decode_primitives() {
    for (const auto& [view, primitives] : by_draco_view_) {
      const std::string& place = primitives.front().place;
      const std::string_view bytes = bytes_of(place, document_["bufferViews"][view]);
      draco::DecoderBuffer buffer;
      buffer.Init(bytes.data(), bytes.size());
      const auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
      if (!mesh.ok()) fail(place, std::string("its Draco data is damaged: ") + mesh.status().error_msg());
      if (mesh.value()->num_points() == 0) fail(place, "its Draco data has no vertices");
      free_view_ = view;
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
    formats::with_type(*formats::gltf_number_type(index_of(accessor, "componentType")), [&](auto zero) {
      using Number = decltype(zero);
      const bool aligned = target == formats::gltf_array_buffer && sizeof zero < 4;
      const std::size_t step = aligned ? (components * sizeof zero + 3) / 4 * 4 / sizeof zero : components;
      std::vector<Number> values(step * count);
      for (std::size_t i = 0; i < count; ++i) get(i, &values[step * i]);
      accessor["count"] = count;
      accessor["bufferView"] = add_view(values.data(), values.size() * sizeof zero);
      Json& view = document_["bufferViews"][accessor["bufferView"].get<std::size_t>()];
      view["target"] = target;
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
    throw base::Error(file_.name, "viete-import was built without Draco, which decompresses its meshes",
                      "install libdraco-dev and build Viete again, or export without compression");
  }
#endif

  formats::GltfFile file_;
  Json& document_;
  std::map<std::size_t, std::vector<Primitive>> by_draco_view_;
  std::string bytes_;                     // the new binary chunk
  std::optional<std::size_t> free_view_;  // a view of compressed data that is no longer needed
};

}  // namespace

std::string decompressed_gltf(const std::filesystem::path& file) {
  const formats::FileBytes bytes(file, nullptr);
  formats::Source source{file.string(), formats::extension_of(file), bytes.view()};
  source.folder = formats::folder_of(file);
  formats::GltfFile taken = formats::take_apart(source, true);
  limit_memory(taken);
  return Decompressor(std::move(taken)).glb();
}

}  // namespace viete::foreign
