// Writes a surface as a new GLB or glTF file.
#include "formats/gltf_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "base/encoding.h"
#include "base/error.h"
#include "base/text.h"
#include "formats/codecs.h"
#include "formats/gltf_morphs.h"
#include "formats/materials.h"
#include "mesh/normals.h"

namespace viete::formats {

namespace {

namespace fs = std::filesystem;

std::size_t padded_to_four(std::size_t size) {
  return (size + 3) / 4 * 4;
}

void put_chunk(std::string_view bytes, std::string_view kind, char padding, TextWriter& out) {
  constexpr std::size_t portion = 1 << 20;
  out.little_endian(static_cast<std::uint32_t>(padded_to_four(bytes.size()))).text(kind);
  for (std::size_t at = 0; at < bytes.size(); at += portion) {
    out.text(bytes.substr(at, portion));
    out.element_done(std::min(at + portion, bytes.size()), bytes.size());
  }
  out.text(std::string(padded_to_four(bytes.size()) - bytes.size(), padding));
}

std::string embedded_uri(std::string_view bytes) {
  return "data:application/octet-stream;base64," + base::base64(bytes);
}

// Percent-encodes a relative path: "a b" becomes "a%20b".
std::string encoded_uri(std::string_view path) {
  return base::percent_encoded(path, [](char c) {
    constexpr std::string_view plain = "-._~/!$&'()*+,;=@";
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           plain.find(c) != std::string_view::npos;
  });
}

template <class Is>
bool any_primitive(const GltfJson& document, const Is& is) {
  for (const GltfJson& mesh : list_of(document, "meshes")) {
    const GltfJson& all = list_of(mesh, "primitives");
    if (std::any_of(all.begin(), all.end(), is)) return true;
  }
  return false;
}

// Custom data of other programs. The names of morph targets are no such data.
bool has_extras(const GltfJson& json) {
  if (!json.is_structured()) return false;
  for (const auto& [key, value] : json.items()) {
    const bool are_names = value.is_object() && value.size() == 1 && value.contains("targetNames");
    if (key == "extras" && json.is_object() ? !value.empty() && !are_names : has_extras(value)) return true;
  }
  return false;
}

// Returns true for extensions whose content is in the surface and its attributes.
bool is_read(const std::string& extension) {
  constexpr std::string_view read[] = {"KHR_texture_transform", "KHR_mesh_quantization", "EXT_texture_webp",
                                       "KHR_texture_basisu", "KHR_materials_unlit"};
  return std::ranges::find(read, extension) != std::end(read);
}

class GltfOriginal final : public Original {
public:
  GltfOriginal(const Source& source, GltfFile file, GltfMap map)
      : Original("glTF", source),
        shared_file_(std::make_shared<const GltfFile>(std::move(file))),
        shared_map_(std::make_shared<const GltfMap>(std::move(map))),
        file_(*shared_file_),
        map_(*shared_map_) {}

  std::vector<std::string> beyond_attributes() const override {
    const GltfJson& document = file_.document;
    std::vector<std::string> found;
    for (const char* key : {"animations", "skins", "cameras"})
      if (!list_of(document, key).empty()) found.emplace_back(key);
    const auto add = [&](const char* what, const auto& is) {
      if (any_primitive(document, is)) found.emplace_back(what);
    };
    add("morph targets", [](const GltfJson& p) { return !list_of(p, "targets").empty(); });
    add("tangents", [](const GltfJson& p) { return accessor_of(p, "TANGENT") >= 0; });
    add("second texture coordinates", [](const GltfJson& p) { return accessor_of(p, "TEXCOORD_1") >= 0; });
    add("points and lines", [](const GltfJson& p) {
      const auto mode = count_of(p, "mode");
      return mode && *mode < 4;
    });
    const auto occluded = [](const GltfJson& m) { return m.contains("occlusionTexture"); };
    if (std::ranges::any_of(list_of(document, "materials"), occluded))
      found.emplace_back("occlusion textures");
    if (file_.has_other_coordinates) found.emplace_back("textures with coordinates of their own");
    if (!text_of(member_of(document, "asset"), "copyright").empty()) found.emplace_back("copyright");
    if (has_extras(document)) found.emplace_back("extras");
    for (const GltfJson& extension : list_of(document, "extensionsUsed"))
      if (extension.is_string() && !is_read(extension))
        found.push_back("extension " + extension.get<std::string>());
    return found;
  }

  Capture capture() const override {
    return is_gltf_capture(file_.document) ? Capture::points : Capture::none;
  }

  std::vector<fs::path> files_beside() const override {
    std::vector<fs::path> files;
    for (const GltfBuffer& buffer : file_.buffers) files.push_back(buffer.path);
    for (const GltfImage& image : file_.images) files.push_back(image.file.path);
    return files;
  }

  // If no position changed, copies the bytes. Otherwise writes a single file with embedded data.
  std::vector<std::string> write(const Content& content, TextWriter& out) const override {
    if (copies(content)) {
      out.text(bytes_);
      return std::vector<std::string>();
    }
    GltfRewritten result = rewritten_gltf(file_, map_, content.surface, content.positions);
    for (std::size_t i = file_.binary ? 1 : 0; i < result.buffers.size(); ++i) embed(result, i);
    put(result, file_.binary, out);
    return std::move(result.notes);
  }

  std::vector<std::string> write_file(const fs::path& path, const Content& content, Digits,
                                      base::Progress* progress) const override {
    const bool binary = extension_of(path) == "glb";
    if (file_.binary == binary && has_no_external_files() && copies(content)) {
      base::replace_file(path, bytes_);
      return {};
    }
    return write_result(path, rewritten_gltf(file_, map_, content.surface, content.positions), progress);
  }

  std::vector<std::string> write_animated(const fs::path& path, const Content& content,
                                          const MorphMotion& motion,
                                          base::Progress* progress) const override {
    const mesh::Surface& rest = content.surface;
    check_motion(motion, rest.positions.size());
    return write_result(path, rewritten_gltf(file_, map_, rest, content.positions, &motion, progress),
                        progress);
  }

  std::shared_ptr<const MorphClip> morphs() const override { return gltf_morphs(shared_file_, shared_map_); }

private:
  std::vector<std::string> write_result(const fs::path& path, GltfRewritten result,
                                        base::Progress* progress) const {
    const bool binary = extension_of(path) == "glb";
    relocate_images(path, result);
    if (!binary && !file_.other_chunks.empty())
      result.notes.push_back("unknown GLB chunks are left out: .gltf files cannot contain chunks");
    base::FilesTogether files;
    put_buffers(path, binary, result, files);
    files.put(path, [&](const base::ByteSink& sink) {
      TextWriter out(sink, progress);
      put(result, binary, out);
      out.finish();
    });
    files.replace();
    return std::move(result.notes);
  }

  bool copies(const Content& content) const { return !bytes_.empty() && content.is_at_rest(); }

  bool has_no_external_files() const {
    return std::ranges::none_of(file_.buffers,
                                [](const GltfBuffer& b) { return b.home == GltfBuffer::Home::beside; }) &&
           std::ranges::all_of(file_.images, [](const GltfImage& i) { return i.uri.empty(); });
  }

  static void embed(GltfRewritten& result, std::size_t buffer) {
    result.document["buffers"][buffer]["uri"] = embedded_uri(result.buffers[buffer]);
  }

  // In a GLB, the first buffer is the binary chunk and has no URI. All other buffers keep their URIs.
  void put(GltfRewritten& result, bool binary, TextWriter& out) const {
    const auto& buffers = result.buffers;
    for (std::size_t i = 0; i < buffers.size(); ++i)
      result.document["buffers"][i]["byteLength"] = buffers[i].size();
    if (!binary) return void(out.text(result.document.dump(2)).text("\n"));
    if (!buffers.empty()) result.document["buffers"][0].erase("uri");
    write_glb_chunks(result.document.dump(), buffers.empty() ? std::string_view() : buffers.front(),
                     file_.other_chunks, out);
  }

  // For a GLB, embeds all buffers except the first, which is the binary chunk. For a .gltf, embeds the
  // buffers that were embedded, and writes all others to external files.
  void put_buffers(const fs::path& path, bool binary, GltfRewritten& result,
                   base::FilesTogether& files) const {
    std::set<fs::path> beside;
    for (std::size_t i = binary ? 1 : 0; i < result.buffers.size(); ++i) {
      if (binary || file_.buffers[i].home == GltfBuffer::Home::text) {
        embed(result, i);
        continue;
      }
      const fs::path name = name_beside(path, beside);
      beside.insert(name);
      files.put(name, [&](const base::ByteSink& sink) { sink(result.buffers[i]); });
      result.document["buffers"][i]["uri"] = encoded_uri(name.filename().string());
    }
    if (beside.empty()) return;
    std::string names;
    for (const fs::path& name : beside) names += (names.empty() ? "" : ", ") + name.string();
    result.notes.push_back(
        (beside.size() == 1 ? "the buffer was written to " : "the buffers were written to ") + names);
  }

  // If the new file is in another folder, changes the relative URIs of images, because images stay in place.
  void relocate_images(const fs::path& path, GltfRewritten& result) const {
    const fs::path to = folder_of(path);
    if (folder_of(file_.name) == to) return;
    std::size_t changed = 0;
    for (std::size_t i = 0; i < file_.images.size(); ++i) {
      const GltfImage& image = file_.images[i];
      if (image.uri.empty() || image.file.path.empty()) continue;
      const fs::path full = folder_of(image.file.path) / image.file.path.filename();
      result.document["images"][i]["uri"] = encoded_uri(full.lexically_relative(to).generic_string());
      ++changed;
    }
    if (changed > 0)
      result.notes.push_back(path.filename().string() + " refers to " + base::counted(changed, "image") +
                             " in the folder of the old file: keep both folders together");
  }

  // Returns the first name of "out.bin", "out-2.bin", ... that is free or a buffer of the older result.
  fs::path name_beside(const fs::path& path, const std::set<fs::path>& taken) const {
    for (int i = 1;; ++i) {
      const std::string number = i == 1 ? "" : "-" + std::to_string(i);
      const fs::path name = path.parent_path() / (path.stem().string() + number + ".bin");
      std::error_code ignored;
      const bool is_there = fs::exists(fs::symlink_status(name, ignored));
      if (taken.count(name) == 0 && (!is_there || is_of_older_result(path, name))) return name;
    }
  }

  // Returns true if the old file at `path`, which will be replaced, refers to this buffer. Then the buffer
  // may be overwritten too. Returns false for buffers of the file that was read.
  bool is_of_older_result(const fs::path& path, const fs::path& buffer) const {
    std::error_code failed;
    for (const GltfBuffer& own : file_.buffers)
      if (!own.path.empty() && fs::equivalent(own.path, buffer, failed)) return false;
    if (!fs::is_regular_file(path, failed) || !fs::is_regular_file(buffer, failed)) return false;
    const FileBytes older(path, nullptr);
    return older.view().find('"' + encoded_uri(buffer.filename().string()) + '"') != std::string_view::npos;
  }

  std::shared_ptr<const GltfFile> shared_file_;
  std::shared_ptr<const GltfMap> shared_map_;
  const GltfFile& file_;
  const GltfMap& map_;
};

// A vertex of the file: the indices of a surface vertex, a texture point, a normal and a coloured face.
struct OutputVertex {
  std::uint32_t vertex, texture, normal, color;
  friend bool operator==(const OutputVertex&, const OutputVertex&) = default;
};

struct HashOfVertex {
  std::size_t operator()(const OutputVertex& v) const {
    return (std::size_t{v.vertex} * 0x9E3779B97F4A7C15U) ^ (std::size_t{v.texture} << 32) ^
           ((std::size_t{v.normal} ^ std::size_t{v.color} << 32) * 0xC2B2AE3D27D4EB4FU);
  }
};

// Consecutive polygons of the same object, which become a node with a mesh.
struct OutputObject {
  std::string name;
  std::vector<OutputVertex> vertices;
  std::map<std::uint32_t, std::vector<std::uint32_t>> indices;  ///< of the triangles of each material
  MorphedVertices written;
};

class GltfMaker {
public:
  explicit GltfMaker(const Content& content)
      : surface_(content.surface), positions_(content.positions), given_(content.given()) {
    document["asset"] = {{"version", "2.0"}, {"generator", "viete"}};
    if (!content.comments.empty()) document["asset"]["extras"] = {{"comments", content.comments}};
    document["scene"] = 0;
    list_normals();
    list_vertices();
    choose_origin();
    for (OutputObject& object : objects_) add_object(object);
    document["buffers"] = {{{"byteLength", bytes.size()}}};
  }

  GltfJson document;
  std::string bytes;

  void animate(const MorphMotion& motion, base::Progress* progress) {
    if (motion.targets.empty()) return;
    mesh::Surface base = surface_;
    base.positions.assign(positions_.begin(), positions_.end());
    GltfMorphs out(document, bytes);
    std::vector<std::size_t> nodes;
    std::size_t floats = 0;
    for (const OutputObject& object : objects_) {
      nodes.push_back(object.written.node);
      floats += object.written.positions.size() + (motion.normals ? object.written.normals.size() : 0);
    }
    out.add(
        motion, nodes, floats, progress,
        [&](const std::vector<mesh::Point>& now) { add_target(out, base, now, motion.normals); },
        [](int) { return std::vector<double>(); });
    document["buffers"] = {{{"byteLength", bytes.size()}}};
  }

private:
  // Collects the given normals. Corners without a normal get a computed vertex normal. Exception: a flat
  // surface without any normal stays without normals.
  void list_normals() {
    normals_ = given_.normals;
    corner_normal_ = given_.corner_normal;
    corner_normal_.resize(surface_.corners.size(), mesh::none);
    const auto without = static_cast<std::size_t>(std::ranges::count(corner_normal_, mesh::none));
    if (without == 0 || (without == corner_normal_.size() && is_flat(given_))) return;
    const std::size_t first = normals_.size();
    normals_.resize(first + positions_.size());
    mesh::vertex_normals(positions_, surface_.triangles,
                         mesh::vertex_triangles(positions_.size(), surface_.triangles), 0, positions_.size(),
                         std::span(normals_).subspan(first));
    for (std::size_t c = 0; c < corner_normal_.size(); ++c)
      if (corner_normal_[c] == mesh::none)
        corner_normal_[c] = static_cast<std::uint32_t>(first + surface_.corners[c]);
  }

  void list_vertices() {
    std::unordered_map<OutputVertex, std::uint32_t, HashOfVertex> numbers;
    std::map<Color, std::uint32_t> first_with_color;  // the first face with each colour
    const bool faces_colored = !given_.polygon_colors.empty() && given_.colors.empty();
    const Group no_group;
    std::size_t t = 0, group = 0;
    for_each_triangle(surface_, [&](const mesh::Triangle& triangle, const mesh::Triangle& corners) {
      const std::uint32_t polygon = surface_.triangle_polygon[t++];
      const std::uint32_t color =
          faces_colored ? first_with_color.try_emplace(given_.polygon_colors[polygon], polygon).first->second
                        : mesh::none;
      while (group + 1 < given_.groups.size() && given_.groups[group + 1].first_polygon <= polygon) ++group;
      const Group& of = given_.groups.empty() ? no_group : given_.groups[group];
      if (objects_.empty() || objects_.back().name != of.object) {
        objects_.push_back({of.object, {}, {}, {}});
        numbers.clear();
      }
      OutputObject& object = objects_.back();
      for (std::size_t k = 0; k < 3; ++k) {
        const OutputVertex v{triangle[k],
                             given_.corner_texture.empty() ? mesh::none : given_.corner_texture[corners[k]],
                             corner_normal_[corners[k]], color};
        const auto [at, added] = numbers.try_emplace(v, static_cast<std::uint32_t>(object.vertices.size()));
        if (added) object.vertices.push_back(v);
        object.indices[of.material].push_back(at->second);
      }
    });
    if (!objects_.empty()) return;
    objects_.emplace_back();
    for (std::uint32_t v = 0; v < positions_.size(); ++v)
      objects_[0].vertices.push_back({v, mesh::none, mesh::none, mesh::none});
  }

  // Far from the origin, floats are too coarse for the model. Then the node's translation is its centre, as
  // floats if they are precise enough, because many programs read the translation in single precision.
  void choose_origin() {
    const mesh::Point& first = positions_[objects_[0].vertices[0].vertex];
    mesh::Bounds box{first, first};
    for (const OutputObject& object : objects_)
      for (const OutputVertex& v : object.vertices) mesh::extend(box, positions_[v.vertex]);
    const double size = box.diagonal(),
                 far = std::max(mesh::largest_abs(box.low), mesh::largest_abs(box.high));
    if (far <= 4 * size || far > largest_float) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const double centre = box.low[k] / 2 + box.high[k] / 2, rounded = static_cast<float>(centre);
      origin_[k] = std::abs(rounded - centre) <= size ? rounded : centre;
    }
  }

  // Unmoved vertices get exactly the values of the file, so that the offsets are exactly 0.
  void add_target(GltfMorphs& out, const mesh::Surface& base, std::span<const mesh::Point> now,
                  bool with_normals) const {
    std::vector<mesh::Vec3> normals;
    if (with_normals && !normals_.empty()) normals = deformed_normals(base, now, normals_, corner_normal_);
    for (const OutputObject& object : objects_) add_target(out, object, now, normals);
  }

  void add_target(GltfMorphs& out, const OutputObject& object, std::span<const mesh::Point> now,
                  std::span<const mesh::Vec3> normals) const {
    const MorphedVertices& written = object.written;
    const bool turns = !normals.empty() && !written.normals.empty();
    std::vector<double> places(written.positions.begin(), written.positions.end()), turned;
    if (turns) turned.assign(written.normals.begin(), written.normals.end());
    for (std::size_t i = 0; i < object.vertices.size(); ++i) {
      const OutputVertex& v = object.vertices[i];
      const auto at = static_cast<std::ptrdiff_t>(3 * i);
      if (now[v.vertex] != positions_[v.vertex])
        std::ranges::copy(now[v.vertex] - origin_, places.begin() + at);
      if (!turns) continue;
      const mesh::Vec3& n = normals[v.normal];
      const double length = mesh::norm(n);
      if (n != normals_[v.normal] && length > 0) std::ranges::copy((1 / length) * n, turned.begin() + at);
    }
    out.add_target(written, places, turned, {});
  }

  // The primitives have the same vertices. Each has the triangles of a material.
  void add_object(OutputObject& object) {
    GltfJson primitive = vertices_of_primitives(object), all = GltfJson::array();
    if (object.indices.empty()) {
      primitive["mode"] = gltf_points;
      all.push_back(primitive);
    }
    for (const auto& [material, indices] : object.indices) {
      primitive["indices"] =
          add_accessor(indices.data(), indices.size(), 1, gltf_unsigned_int, gltf_element_buffer);
      primitive.erase("material");
      if (material < given_.materials.size()) primitive["material"] = material_number(material);
      all.push_back(primitive);
    }
    for (std::size_t i = 0; i < all.size(); ++i) object.written.primitives.push_back(i);
    const std::size_t node = object.written.node = list_of(document, "nodes").size();
    document["scenes"][0]["nodes"].push_back(node);
    document["meshes"].push_back({{"primitives", std::move(all)}});
    document["nodes"].push_back({{"mesh", node}});
    if (!object.name.empty()) document["nodes"][node]["name"] = object.name;
    if (origin_ != mesh::Vec3{0, 0, 0}) document["nodes"][node]["translation"] = origin_;
  }

  // Returns the index in the document. The first use adds the material.
  std::size_t material_number(std::uint32_t material) {
    const auto [at, is_new] = material_numbers_.try_emplace(material, material_numbers_.size());
    if (is_new) add_material(given_.materials[material]);
    return at->second;
  }

  // Back faces are visible, because most formats cannot hide them.
  void add_material(const Material& m) {
    GltfJson made = {{"name", m.name}, {"doubleSided", true}}, surface;
    const auto linear = [](const Color& c) {
      return GltfJson{linear_of_srgb(c[0]), linear_of_srgb(c[1]), linear_of_srgb(c[2])};
    };
    surface["baseColorFactor"] = linear(m.base_color);
    surface["baseColorFactor"].push_back(m.base_color[3]);
    for (const MaterialNumber& property : material_numbers) surface[property.gltf] = m.*property.number;
    for (const MaterialImage& property : material_images)
      if (const std::uint32_t image = m.*property.image; image != mesh::none)
        (property.gltf_parent ? surface : made)[property.gltf]["index"] = add_texture(image, m.repeats);
    made["pbrMetallicRoughness"] = surface;
    made["emissiveFactor"] = linear(m.emission);
    if (m.is_translucent || m.base_color[3] < 1) made["alphaMode"] = "BLEND";
    document["materials"].push_back(made);
  }

  std::size_t add_texture(std::uint32_t image, bool repeats) {
    const auto [at, is_new] = image_numbers_.try_emplace(image, image_numbers_.size());
    if (is_new) {
      const ImageFile& file = given_.images[image];
      const std::string& data = *file.bytes;
      const std::size_t view = add_gltf_view(document, bytes, data.data(), data.size());
      document["images"].push_back({{"name", fs::path(file.name).stem().string()},
                                    {"mimeType", data.starts_with('\xFF') ? "image/jpeg" : "image/png"},
                                    {"bufferView", view}});
    }
    GltfJson texture = {{"source", at->second}};
    if (!repeats) {
      document["samplers"] = {{{"wrapS", gltf_clamp_to_edge}, {"wrapT", gltf_clamp_to_edge}}};
      texture["sampler"] = 0;
    }
    document["textures"].push_back(texture);
    return document["textures"].size() - 1;
  }

  GltfJson vertices_of_primitives(OutputObject& object) {
    GltfJson made = {{"attributes", GltfJson::object()}};
    GltfJson& attributes = made["attributes"];
    const auto has = [&](std::uint32_t OutputVertex::*part) {
      return std::ranges::any_of(object.vertices, [&](const auto& v) { return v.*part != mesh::none; });
    };
    object.written.positions =
        add_vectors(object.vertices, attributes["POSITION"], 3, [&](const OutputVertex& v, float* to) {
          check_written("glTF", v.vertex, positions_[v.vertex], largest_float);
          for (std::size_t k = 0; k < 3; ++k)
            to[k] = static_cast<float>(positions_[v.vertex][k] - origin_[k]);
        });
    if (has(&OutputVertex::normal)) {
      object.written.normals =
          add_vectors(object.vertices, attributes["NORMAL"], 3, [&](const OutputVertex& v, float* to) {
            const mesh::Vec3& n = normals_[v.normal];
            const double length = mesh::norm(n);
            for (std::size_t k = 0; k < 3; ++k)
              to[k] = static_cast<float>(length > 0 ? n[k] / length : k == 2);
          });
    }
    if (has(&OutputVertex::texture)) {
      add_vectors(object.vertices, attributes["TEXCOORD_0"], 2, [&](const OutputVertex& v, float* to) {
        const Vec2 p = v.texture == mesh::none ? Vec2{0, 0} : given_.texture_points[v.texture];
        to[0] = static_cast<float>(p[0]);
        to[1] = static_cast<float>(1 - p[1]);
      });
    }
    if (!given_.colors.empty() || has(&OutputVertex::color)) {
      add_vectors(object.vertices, attributes["COLOR_0"], 4, [&](const OutputVertex& v, float* to) {
        const Color& c = v.color == mesh::none ? given_.colors[v.vertex] : given_.polygon_colors[v.color];
        for (std::size_t k = 0; k < 4; ++k) to[k] = static_cast<float>(k < 3 ? linear_of_srgb(c[k]) : c[k]);
      });
    }
    return made;
  }

  // Adds an accessor with values of the vertices. Stores the accessor's index in `attribute`.
  template <class Fill>
  std::vector<float> add_vectors(const std::vector<OutputVertex>& vertices, GltfJson& attribute,
                                 std::size_t components, const Fill& fill) {
    std::vector<float> values(vertices.size() * components);
    for (std::size_t i = 0; i < vertices.size(); ++i) fill(vertices[i], &values[i * components]);
    const std::size_t accessor =
        add_accessor(values.data(), vertices.size(), components, gltf_float, gltf_array_buffer);
    if (components == 3) set_gltf_bounds(document["accessors"][accessor], values, components);
    attribute = accessor;
    return values;
  }

  std::size_t add_accessor(const void* data, std::size_t count, std::size_t components, int type,
                           int target) {
    static constexpr const char* types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const std::size_t view = add_gltf_view(document, bytes, data, 4 * count * components);
    document["bufferViews"][view]["target"] = target;
    document["accessors"].push_back(
        {{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", types[components]}});
    return document["accessors"].size() - 1;
  }

  const mesh::Surface& surface_;
  std::span<const mesh::Point> positions_;
  mesh::Vec3 origin_{0, 0, 0};  // the node's translation
  const Attributes& given_;
  std::vector<mesh::Vec3> normals_;
  std::vector<std::uint32_t> corner_normal_;  // indices into normals_
  std::vector<OutputObject> objects_;
  // For each material or image that is used, its index in the document.
  std::map<std::uint32_t, std::size_t> material_numbers_, image_numbers_;
};

// Replaces bytes that are not UTF-8. Names from other files may contain such bytes.
std::string json_text(const GltfJson& document, int indent = -1) {
  return document.dump(indent, ' ', false, GltfJson::error_handler_t::replace);
}

}  // namespace

bool is_gltf_capture(const GltfJson& document) {
  return any_primitive(document, [](const GltfJson& p) {
    return !member_of(member_of(p, "extensions"), "KHR_gaussian_splatting").is_null();
  });
}

void write_glb_chunks(std::string_view json, std::string_view bytes, std::string_view others,
                      TextWriter& out) {
  const std::size_t binary = bytes.empty() ? 0 : 8 + padded_to_four(bytes.size());
  const std::size_t all = 20 + padded_to_four(json.size()) + binary + others.size();
  if (all > std::numeric_limits<std::uint32_t>::max())
    throw base::Error("", "the GLB file would exceed its limit of 4 GB", "save as .gltf or another format");
  out.text("glTF").little_endian(std::uint32_t{2}).little_endian(static_cast<std::uint32_t>(all));
  put_chunk(json, {"JSON", 4}, ' ', out);
  if (!bytes.empty()) put_chunk(bytes, {"BIN\0", 4}, '\0', out);
  out.text(others);
}

std::shared_ptr<const Original> gltf_original(const Source& source, GltfFile file, GltfMap map) {
  return std::make_shared<GltfOriginal>(source, std::move(file), std::move(map));
}

void write_glb(const Content& content, TextWriter& out) {
  write_gltf_animated(content, {}, true, out, nullptr);
}

void write_gltf(const Content& content, TextWriter& out) {
  write_gltf_animated(content, {}, false, out, nullptr);
}

void write_gltf_animated(const Content& content, const MorphMotion& motion, bool binary, TextWriter& out,
                         base::Progress* progress) {
  GltfMaker made(content);
  made.animate(motion, progress);
  if (binary) return write_glb_chunks(json_text(made.document), made.bytes, {}, out);
  made.document["buffers"][0]["uri"] = embedded_uri(made.bytes);
  out.text(json_text(made.document, 2)).text("\n");
}

}  // namespace viete::formats
