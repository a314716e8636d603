// Writes a surface as a new GLB or glTF file.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

#include "base/text.h"
#include "formats/codecs.h"
#include "formats/gltf_morphs.h"
#include "formats/gltf_original.h"
#include "formats/materials.h"
#include "mesh/normals.h"

namespace viete::formats {

namespace {

namespace fs = std::filesystem;

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
    for (const Material& material : given_.materials) add_material(material);
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
      if (material < given_.materials.size()) primitive["material"] = material;
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
  std::map<std::uint32_t, std::size_t> image_numbers_;  // for each used image, its index in the document
};

// Replaces bytes that are not UTF-8. Names from other files may contain such bytes.
std::string json_text(const GltfJson& document, int indent = -1) {
  return document.dump(indent, ' ', false, GltfJson::error_handler_t::replace);
}

}  // namespace

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
  made.document["buffers"][0]["uri"] = embedded_gltf_uri(made.bytes);
  out.text(json_text(made.document, 2)).text("\n");
}

}  // namespace viete::formats
