#include "formats/gltf_file.h"

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "base/byte_order.h"
#include "base/encoding.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "formats/read.h"

namespace viete::formats {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view base64_mark = ";base64,";

[[noreturn]] void refuse_gltf(const Source& source, const std::string& problem,
                              const std::string& advice = "export the model again") {
  throw base::Error(source.name, problem, advice);
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  return base::number_of_bytes<std::uint32_t>(bytes.data() + at);
}

struct Chunks {
  std::string_view json;
  std::optional<std::string_view> binary;
  std::string others = {};  // unknown chunks, for writing the file again
};

Chunks chunks_of(const Source& source) {
  constexpr std::uint32_t json_kind = 0x4E4F534A, binary_kind = 0x004E4942;
  if (source.bytes.size() < 20) refuse_gltf(source, "the file ends within its header");
  if (word_at(source.bytes, 4) != 2)
    refuse_gltf(source, "version " + std::to_string(word_at(source.bytes, 4)) + " of GLB is not supported",
                "export as glTF 2.0");
  const std::size_t length = word_at(source.bytes, 8);
  if (length > source.bytes.size())
    refuse_gltf(source,
                "the header declares " + std::to_string(length) + " bytes, the file has " +
                    std::to_string(source.bytes.size()),
                "the file seems to be truncated: export or copy it again");
  Chunks chunks;
  for (std::size_t at = 12; at + 8 <= length;) {
    const std::size_t size = word_at(source.bytes, at), kind = word_at(source.bytes, at + 4);
    at += 8;
    if (size > length - at) refuse_gltf(source, "a chunk is longer than the file");
    const std::string_view chunk = source.bytes.substr(at, size);
    if (at == 20 && kind == json_kind) chunks.json = chunk;
    const bool is_binary = kind == binary_kind && !chunks.binary;
    if (at > 20 && is_binary) chunks.binary = chunk;
    if (at > 20 && !is_binary) chunks.others.append(source.bytes.substr(at - 8, size + 8));
    at += size;
    if (chunks.json.empty()) refuse_gltf(source, "the first chunk is not JSON");
  }
  return chunks;
}

// Rejects JSON that is nested too deeply for the stack. Also rejects objects with too many members, because
// the search for a member is linear.
void check_shape(const Source& source, std::string_view text) {
  constexpr std::size_t deepest = 64, most_members = 4096;
  std::array<std::size_t, deepest + 1> members{};
  std::array<bool, deepest + 1> is_object{};
  std::size_t depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > deepest) refuse_gltf(source, "the JSON is nested more than 64 levels deep");
      members[depth] = 0;
      is_object[depth] = c == '{';
    } else if (c == '}' || c == ']') {
      if (depth > 0) --depth;
    } else if (c == ',' && is_object[depth] && ++members[depth] > most_members) {
      refuse_gltf(source, "an object of the JSON has more than 4096 members");
    }
  }
}

GltfJson parsed(const Source& source, std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  check_shape(source, text);
  try {
    GltfJson document = GltfJson::parse(text.begin(), text.end());
    if (!document.is_object()) refuse_gltf(source, "the JSON is not an object");
    return document;
  } catch (const GltfJson::parse_error& error) {
    refuse_gltf(source, "invalid JSON at byte " + std::to_string(error.byte));
  } catch (const GltfJson::exception&) {
    refuse_gltf(source, "the JSON contains an invalid number");
  }
}

std::string embedded(const Source& source, const std::string& place, std::string_view uri) {
  const auto mark = uri.substr(0, 256).find(base64_mark);
  auto bytes = mark == uri.npos ? std::nullopt : base::bytes_of_base64(uri.substr(mark + base64_mark.size()));
  if (!bytes)
    throw base::Error(source.name + ": " + place, "the embedded data is not base64",
                      "export the model again");
  return *std::move(bytes);
}

// Returns the path for a relative URI, or nullopt for other URIs.
std::optional<fs::path> path_of_uri(const Source& source, std::string_view uri) {
  const fs::path relative = base::percent_decoded(uri);
  const std::string text = relative.string();
  const bool refused = relative.empty() || relative.is_absolute() || text.find('\0') != std::string::npos ||
                       text.find("://") != std::string::npos;
  if (refused) return std::nullopt;
  return fs::path(source.name).parent_path() / relative;
}

// Works like path_of_uri(), but also returns nullopt for a path with "..". Buffers become part of the output,
// so only buffers in the model's folder may be read.
std::optional<fs::path> path_within(const Source& source, std::string_view uri) {
  const auto path = path_of_uri(source, uri);
  const fs::path relative = base::percent_decoded(uri);
  const bool leads_out =
      std::any_of(relative.begin(), relative.end(), [](const fs::path& p) { return p == ".."; });
  return leads_out ? std::nullopt : path;
}

// Checks the types of members of scenes, nodes, meshes, accessors and buffer views. Checks that all other
// lists contain objects. For wrong types, throws base::Error.
class GltfShape {
public:
  GltfShape(const std::string& name, const GltfJson& document) : name_(name), document_(document) {}

  void check() const {
    whole("", document_, {"scene"});
    each("", document_, "scenes", "scene ", [&](auto& at, auto& scene) { wholes(at, scene, "nodes"); });
    each("", document_, "nodes", "node ", [&](auto& at, auto& node) {
      whole(at, node, {"mesh", "skin"});
      wholes(at, node, "children");
      for (const char* key : {"matrix", "translation", "rotation", "scale"})
        list(at, node, key, "a list of numbers", [](auto& value) { return value.is_number(); });
    });
    each("", document_, "meshes", "mesh ", [&](auto& at, auto& mesh) {
      if (!mesh.contains("primitives")) fail(at, "has no \"primitives\"");
      each(at, mesh, "primitives", ", primitive ", [&](auto& in, auto& p) { check_primitive(in, p); });
    });
    each("", document_, "accessors", "accessor ", [&](auto& at, auto& a) {
      check_data(at, a);
      const GltfJson& sparse = object(at, a, "sparse");
      whole(at, sparse, {"count"});
      for (const char* part : {"indices", "values"}) check_data(at, object(at, sparse, part));
    });
    each("", document_, "bufferViews", "buffer view ", [&](auto& at, auto& view) {
      whole(at, view, {"buffer", "byteOffset", "byteLength", "byteStride"});
    });
    for (const char* key :
         {"buffers", "images", "materials", "textures", "samplers", "animations", "skins", "cameras"})
      each("", document_, key, "", [](auto&, auto&) {});
  }

private:
  void check_primitive(const std::string& at, const GltfJson& primitive) const {
    for (const auto& [attribute, value] : object(at, primitive, "attributes").items())
      accessor(at, attribute, value);
    accessor(at, "indices", member_of(primitive, "indices"));
    whole(at, primitive, {"material", "mode"});
    each(at, primitive, "targets", ", target ", [&](auto& in, auto& target) {
      for (const auto& [key, value] : target.items()) accessor(in, key, value);
    });
  }

  // `data` is an accessor, or the member `indices` or `values` of a sparse accessor.
  void check_data(const std::string& at, const GltfJson& data) const {
    whole(at, data, {"bufferView", "byteOffset", "componentType", "count"});
    const auto view = count_of(data, "bufferView");
    if (view && *view >= list_of(document_, "bufferViews").size())
      fail(at, "refers to buffer view " + std::to_string(*view) + ", which does not exist");
  }

  void accessor(const std::string& at, const std::string& key, const GltfJson& value) const {
    if (value.is_null()) return;
    const auto index = count_of(value);
    if (!index) fail(at, "\"" + key + "\" should be the index of an accessor");
    const std::size_t count = list_of(document_, "accessors").size();
    if (*index >= count)
      fail(at, "\"" + key + "\" refers to accessor " + std::to_string(*index) + ", the file has " +
                   std::to_string(count) + ", counted from 0");
  }

  void whole(const std::string& at, const GltfJson& of, std::initializer_list<const char*> keys) const {
    for (const char* key : keys)
      member(at, of, key, "a whole number that is not negative", count_of(member_of(of, key)).has_value());
  }

  void wholes(const std::string& at, const GltfJson& of, const char* key) const {
    list(at, of, key, "a list of whole numbers that are not negative",
         [](auto& value) { return count_of(value).has_value(); });
  }

  template <class Is>
  void list(const std::string& at, const GltfJson& of, const char* key, const char* form,
            const Is& is) const {
    const GltfJson& value = member_of(of, key);
    member(at, of, key, form, value.is_array() && std::all_of(value.begin(), value.end(), is));
  }

  const GltfJson& object(const std::string& at, const GltfJson& of, const char* key) const {
    member(at, of, key, "an object", member_of(of, key).is_object());
    return member_of(of, key);
  }

  template <class Check>
  void each(const std::string& at, const GltfJson& of, const char* key, const char* element,
            const Check& check) const {
    list(at, of, key, "a list of objects", [](auto& value) { return value.is_object(); });
    const GltfJson& entries = list_of(of, key);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const std::string place = at + element + std::to_string(i);
      check(place, entries[i]);
    }
  }

  // Throws base::Error if the member exists and `good` is false. A JSON null counts as existing.
  void member(const std::string& at, const GltfJson& of, const char* key, const char* form, bool good) const {
    if (!good && of.is_object() && of.contains(key))
      fail(at, "\"" + std::string(key) + "\" should be " + form);
  }

  [[noreturn]] void fail(const std::string& at, const std::string& problem) const {
    throw base::Error(at.empty() ? name_ : name_ + ": " + at, problem, "export the model again");
  }

  const std::string& name_;
  const GltfJson& document_;
};

class GltfTaker {
public:
  GltfTaker(const Source& source, const Chunks& chunks, bool binary, bool may_be_compressed)
      : source_(source), chunks_(chunks), document_(file_.document), may_be_compressed_(may_be_compressed) {
    file_.name = source.name;
    file_.binary = binary;
    document_ = parsed(source, chunks.json);
  }

  GltfFile take() {
    check_version();
    check_extensions();
    GltfShape(source_.name, document_).check();
    const std::size_t buffers = list_of(document_, "buffers").size();
    for (std::size_t i = 0; i < buffers; ++i) take_buffer(i);
    for (const GltfBuffer& buffer : file_.buffers) left_for_images_ += buffer.bytes.size();
    for (std::size_t i = 0; i < list_of(document_, "images").size(); ++i) take_image(i);
    warn_about_ignored_content();
    file_.other_chunks = std::move(chunks_.others);
    return std::move(file_);
  }

private:
  void check_version() {
    const std::string version = text_of(member_of(document_, "asset"), "version");
    if (version.empty()) refuse_gltf(source_, "this JSON is not glTF: it has no asset version");
    if (!version.starts_with("2."))
      refuse_gltf(source_, "glTF " + version.substr(0, 16) + " is not supported", "export as glTF 2.0");
  }

  void check_extensions() {
    for (const char* key : {"extensionsUsed", "extensionsRequired"})
      for (const GltfJson& extension : list_of(document_, key))
        if (extension.is_string()) check_extension(extension.get<std::string>(), key[10] == 'R');
  }

  void check_extension(const std::string& name, bool required) {
    static const std::set<std::string> known = {"KHR_mesh_quantization", "KHR_texture_transform",
                                                "KHR_lights_punctual",   "KHR_texture_basisu",
                                                "EXT_texture_webp",      "KHR_animation_pointer"};
    if (compresses_gltf(name) && !may_be_compressed_) throw CompressedGltf(source_.name, name);
    if (!required || compresses_gltf(name) || known.count(name) || name.starts_with("KHR_materials_")) return;
    refuse_gltf(source_, "the file requires the extension " + name.substr(0, 64) + ", which is not supported",
                "export without this extension");
  }

  void take_buffer(std::size_t i) {
    const std::string place = "buffer " + std::to_string(i);
    const auto fail = [&](const std::string& problem) {
      throw base::Error(source_.name + ": " + place, problem, "export the model and its buffers again");
    };
    GltfJson& json = document_["buffers"][i];
    const auto length = count_of(json, "byteLength");
    if (!length || *length == 0) fail("has no byteLength");
    const std::string uri = text_of(json, "uri");
    GltfBuffer buffer;
    if (uri.starts_with("data:")) {
      buffer.home = GltfBuffer::Home::text;
      buffer.bytes = embedded(source_, place, uri);
      json.erase("uri");
    } else if (!uri.empty()) {
      buffer.home = GltfBuffer::Home::beside;
      const auto path = path_within(source_, uri);
      if (!path) fail("is not in the folder of the model: " + uri.substr(0, 200));
      buffer.path = path->lexically_normal();
      const bool again = !beside_.insert(buffer.path).second;
      buffer.bytes = base::FileBytes(*path).view();
      if (again && (repeated_ += buffer.bytes.size()) > most_repeated_bytes)
        fail("refers to the same file as other buffers, more than 256 MB in total");
    } else if (i == 0 && chunks_.binary) {
      buffer.bytes = *chunks_.binary;
    } else if (may_be_compressed_) {
      return file_.buffers.push_back(std::move(buffer));
    } else {
      fail("has neither data nor a URI");
    }
    if (buffer.bytes.size() < *length && !buffer.path.empty())
      refuse_foreign(buffer.path.string(), buffer.bytes);
    if (buffer.bytes.size() < *length)
      fail("declares " + std::to_string(*length) + " bytes and has " + std::to_string(buffer.bytes.size()));
    buffer.bytes.resize(*length);
    file_.buffers.push_back(std::move(buffer));
  }

  void take_image(std::size_t i) {
    const GltfJson& json = document_["images"][i];
    GltfImage image;
    image.file.name = text_of(json, "name");
    const std::string uri = text_of(json, "uri");
    if (uri.starts_with("data:")) {
      const std::string place = "image " + std::to_string(i);
      image.file.bytes = std::make_shared<const std::string>(embedded(source_, place, uri));
    } else if (!uri.empty()) {
      take_image_beside(image, uri);
    } else {
      image.file.bytes = bytes_of_view(count_of(json, "bufferView"));
      if (!image.file.bytes) warn("image " + std::to_string(i) + " has no data and is ignored");
    }
    file_.images.push_back(std::move(image));
  }

  void take_image_beside(GltfImage& image, const std::string& uri) {
    image.uri = uri;
    if (const auto path = path_of_uri(source_, uri)) {
      image.file.path = fs::absolute(*path);
    } else {
      warn("image " + uri.substr(0, 200) + " is not a relative file path and is not opened");
    }
  }

  // Returns the bytes of a buffer view, or null. Copies each view only once. Views can overlap, so all copies
  // together are limited to the size of the buffers.
  std::shared_ptr<const std::string> bytes_of_view(std::optional<std::uint64_t> view) {
    const GltfJson& views = list_of(document_, "bufferViews");
    if (!view || *view >= views.size()) return nullptr;
    const GltfJson& json = views[*view];
    const auto buffer = count_of(json, "buffer"), length = count_of(json, "byteLength");
    const std::uint64_t offset = count_of(json, "byteOffset").value_or(0);
    if (!buffer || !length || *buffer >= file_.buffers.size()) return nullptr;
    const std::string& bytes = file_.buffers[*buffer].bytes;
    if (offset > bytes.size() || *length > bytes.size() - offset) return nullptr;
    auto& kept = of_view_[*view];
    if (!kept && *length <= left_for_images_) {
      kept = std::make_shared<const std::string>(bytes, offset, *length);
      left_for_images_ -= *length;
    }
    return kept;
  }

  void warn_about_ignored_content() {
    std::string list;
    for (const char* key : {"animations", "skins", "cameras"}) {
      if (key == std::string_view("animations") && (source_.played || !has_animation(document_, false)))
        continue;  // the reader or the caller names animations of morph targets
      if (!list_of(document_, key).empty()) list += (list.empty() ? "" : ", ") + std::string(key);
    }
    if (!list.empty()) warn(list + " are ignored");
    for (const GltfJson& node : list_of(document_, "nodes")) {
      if (member_of(member_of(node, "extensions"), "EXT_mesh_gpu_instancing").is_null()) continue;
      return warn("EXT_mesh_gpu_instancing is not supported: each instanced mesh is shown once");
    }
  }

  void warn(const std::string& text) { file_.warnings.push_back(text); }

  const Source& source_;
  Chunks chunks_;
  GltfFile file_;
  GltfJson& document_;
  bool may_be_compressed_;
  static constexpr std::size_t most_repeated_bytes = std::size_t{1} << 28;
  std::set<fs::path> beside_;
  std::size_t repeated_ = 0;
  std::map<std::uint64_t, std::shared_ptr<const std::string>> of_view_;
  std::uint64_t left_for_images_ = 0;
};

using Numbers = std::vector<double>;

[[noreturn]] void refuse_node(const GltfFile& file, int node, const std::string& problem) {
  throw base::Error(file.name + ": node " + std::to_string(node), problem, "export the model again");
}

AffineMap from_matrix(const Numbers& m) {
  AffineMap map;
  for (std::size_t k = 0; k < 3; ++k) map.columns[k] = {m[4 * k], m[4 * k + 1], m[4 * k + 2]};
  map.offset = {m[12], m[13], m[14]};
  return map;
}

AffineMap from_rotation(const Numbers& q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(length > 0)) return {};
  const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
  AffineMap map;
  map.columns = {{{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                  {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                  {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}}};
  return map;
}

AffineMap map_of_node(const GltfFile& file, int index, const GltfJson& node) {
  const auto numbers = [&](const char* key, std::size_t count) {
    Numbers numbers;
    for (const GltfJson& number : list_of(node, key)) numbers.push_back(number.get<double>());
    if (!numbers.empty() && numbers.size() != count)
      refuse_node(file, index,
                  "\"" + std::string(key) + "\" has " + std::to_string(numbers.size()) +
                      " numbers instead of " + std::to_string(count));
    return numbers;
  };
  if (const Numbers matrix = numbers("matrix", 16); !matrix.empty()) return from_matrix(matrix);
  const Numbers rotation = numbers("rotation", 4), scale = numbers("scale", 3),
                translation = numbers("translation", 3);
  AffineMap map = rotation.empty() ? AffineMap{} : from_rotation(rotation);
  for (std::size_t k = 0; k < scale.size(); ++k) map.columns[k] = scale[k] * map.columns[k];
  if (!translation.empty()) map.offset = {translation[0], translation[1], translation[2]};
  return map;
}

class NodeWalk {
public:
  explicit NodeWalk(const GltfFile& file) : file_(file), nodes_(list_of(file.document, "nodes")) {}

  std::vector<GltfPlacement> walk() {
    seen_.assign(nodes_.size(), 0);
    open_children(roots(), {});
    while (!open_.empty()) visit();
    return std::move(placements_);
  }

private:
  struct Open {
    std::size_t node;
    AffineMap parent;
  };

  static std::vector<std::size_t> listed(const GltfJson& of, const char* key) {
    std::vector<std::size_t> all;
    for (const GltfJson& index : list_of(of, key)) all.push_back(index.get<std::size_t>());
    return all;
  }

  std::vector<std::size_t> roots() const {
    const GltfJson& scenes = list_of(file_.document, "scenes");
    if (!scenes.empty()) {
      const std::size_t scene = count_of(file_.document, "scene").value_or(0);
      if (scene >= scenes.size())
        throw base::Error(file_.name,
                          "scene " + std::to_string(scene) + " does not exist, the file has " +
                              std::to_string(scenes.size()) + " scenes, counted from 0",
                          "export the model again");
      return listed(scenes[scene], "nodes");
    }
    std::vector<char> is_child(nodes_.size(), 0);
    for (const GltfJson& node : nodes_)
      for (const std::size_t child : listed(node, "children"))
        if (child < is_child.size()) is_child[child] = 1;
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) roots.push_back(i);
    return roots;
  }

  void open_children(const std::vector<std::size_t>& nodes, const AffineMap& parent) {
    for (std::size_t i = nodes.size(); i-- > 0;) open_.push_back({nodes[i], parent});
  }

  void visit() {
    const auto [index, parent] = open_.back();
    open_.pop_back();
    const int number = static_cast<int>(index);
    if (index >= nodes_.size())
      refuse_node(file_, number,
                  "does not exist, the file has " + std::to_string(nodes_.size()) + " nodes, counted from 0");
    if (seen_[index]) refuse_node(file_, number, "is placed twice, but may have only one parent");
    seen_[index] = 1;
    const GltfJson& node = nodes_[index];
    const AffineMap map = parent * map_of_node(file_, number, node);
    if (const int mesh = index_of(node, "mesh"); mesh >= 0) place(number, mesh, node, map);
    open_children(listed(node, "children"), map);
  }

  void place(int index, int mesh, const GltfJson& node, const AffineMap& map) {
    if (element_of(file_.document, "meshes", mesh).is_null())
      refuse_node(file_, index, "refers to mesh " + std::to_string(mesh) + ", which does not exist");
    // Bones place a skinned mesh; its node has no effect. Bones at rest do not move the mesh.
    placements_.push_back({index, mesh, index_of(node, "skin") >= 0 ? AffineMap{} : map});
  }

  const GltfFile& file_;
  const GltfJson& nodes_;
  std::vector<char> seen_;
  std::vector<Open> open_;
  std::vector<GltfPlacement> placements_;
};

}  // namespace

bool has_animation(const GltfJson& document, bool weights) {
  for (const GltfJson& animation : list_of(document, "animations"))
    for (const GltfJson& channel : list_of(animation, "channels"))
      if ((text_of(member_of(channel, "target"), "path") == "weights") == weights) return true;
  return false;
}

bool compresses_gltf(std::string_view extension) {
  return extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression" ||
         extension == "KHR_meshopt_compression";
}

GltfFile take_apart(const Source& source, bool may_be_compressed) {
  const bool binary = source.bytes.starts_with("glTF");
  return GltfTaker(source, binary ? chunks_of(source) : Chunks{source.bytes, std::nullopt, {}}, binary,
                   may_be_compressed)
      .take();
}

mesh::Vec3 AffineMap::of_normal(const mesh::Vec3& n) const {
  const mesh::Vec3 turned = n[0] * mesh::cross(columns[1], columns[2]) +
                            n[1] * mesh::cross(columns[2], columns[0]) +
                            n[2] * mesh::cross(columns[0], columns[1]);
  return determinant() < 0 ? -1 * turned : turned;
}

std::optional<AffineMap> AffineMap::inverse() const {
  const double d = determinant();
  const double size = mesh::norm(columns[0]) * mesh::norm(columns[1]) * mesh::norm(columns[2]);
  if (!(std::abs(d) > 1e-12 * size)) return std::nullopt;
  const mesh::Vec3 rows[3] = {(1 / d) * mesh::cross(columns[1], columns[2]),
                              (1 / d) * mesh::cross(columns[2], columns[0]),
                              (1 / d) * mesh::cross(columns[0], columns[1])};
  AffineMap inverse;
  for (std::size_t k = 0; k < 3; ++k) inverse.columns[k] = {rows[0][k], rows[1][k], rows[2][k]};
  inverse.offset = -1 * inverse.of_vector(offset);
  return inverse;
}

AffineMap operator*(const AffineMap& a, const AffineMap& b) {
  if (a.is_identity()) return b;
  AffineMap product;
  for (std::size_t k = 0; k < 3; ++k) product.columns[k] = a.of_vector(b.columns[k]);
  product.offset = a.of_point(b.offset);
  return product;
}

std::vector<GltfPlacement> placements_of(const GltfFile& file) {
  return NodeWalk(file).walk();
}

}  // namespace viete::formats
