#include "mesh/formats/gltf_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>

#include "base/encoding.h"
#include "base/error.h"
#include "mesh/formats/conversion.h"
#include "mesh/formats/gltf_file.h"
#include "mesh/formats/gltf_morph_output.h"
#include "mesh/formats/written_positions.h"
#include "mesh/normals.h"

namespace viete::mesh {

namespace {

double linear_of_srgb(double x) {
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

std::array<double, 4> linear_of_srgb(const Color& c) {
  return {linear_of_srgb(c[0]), linear_of_srgb(c[1]), linear_of_srgb(c[2]), c[3]};
}

// What a glTF image may be; otherwise empty.
std::string_view mime_type_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return "image/png";
  if (bytes.starts_with("\xFF\xD8")) return "image/jpeg";
  return {};
}

// A vertex of the file: one of the surface with a texture point, a normal and the colour of a face.
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

class GltfMaker {
public:
  explicit GltfMaker(const Content& content, bool animated = false)
      : surface_(content.surface), positions_(content.positions), animated_(animated) {
    if (content.attributes) given_ = *content.attributes;
    if (given_.groups.empty() || given_.groups.front().first_polygon != 0)
      given_.groups.insert(given_.groups.begin(), Group{});
    document["asset"] = {{"version", "2.0"}, {"generator", "viete"}};
    if (!content.comments.empty()) document["asset"]["extras"] = {{"comments", content.comments}};
    document["scene"] = 0;
    objects_ = objects_of(surface_, given_);
    for (std::size_t i = 0; i < objects_.names.size(); ++i) add_node(i, objects_.names[i]);
    add_primitives();
    add_materials();
    document["buffers"] = {{{"byteLength", bytes.size()}}};
  }

  GltfJson document;
  std::string bytes;

  // After all else.
  void animate(const MorphMotion& motion, base::Progress* progress) {
    if (motion.targets.empty()) return;
    Surface base = surface_;
    base.positions.assign(positions_.begin(), positions_.end());
    list_normals();
    GltfMorphs out(document, bytes);
    const std::size_t count = motion.targets.size();
    bytes.reserve(bytes.size() + count * floats_moved(motion.normals) * sizeof(float));
    for (std::size_t t = 0; t < count; ++t) {
      if (progress) progress->report(0.9 * static_cast<double>(t) / static_cast<double>(count));
      add_target(out, base, motion.positions(t), motion.normals);
    }
    std::vector<std::size_t> nodes;  // of which each primitive is one of consecutive ones
    for (const Made& made : made_) {
      if (nodes.empty() || nodes.back() != made.as_written.node) nodes.push_back(made.as_written.node);
    }
    out.finish(motion, nodes, std::vector<std::size_t>(nodes.size(), 0),
               [](int) { return std::vector<double>(); });
    document["buffers"] = {{{"byteLength", bytes.size()}}};
  }

private:
  struct Run {
    std::vector<OutputVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::unordered_map<OutputVertex, std::uint32_t, HashOfVertex> numbers;
  };

  // A primitive that is there, and what its vertices are.
  struct Made {
    MorphedVertices as_written;
    std::vector<OutputVertex> vertices;
    bool has_normals;
  };

  // Those of the file and then those computed for vertices without, as corners and vertices name them.
  void list_normals() {
    normals_ = given_.normals;
    normals_.insert(normals_.end(), vertex_normals_.begin(), vertex_normals_.end());
    corner_normal_.resize(surface_.corners.size());
    for (std::size_t c = 0; c < corner_normal_.size(); ++c)
      corner_normal_[c] =
          normal_of(surface_.corners[c], given_.corner_normal.empty() ? none : given_.corner_normal[c]);
  }

  std::uint32_t normal_of(std::uint32_t vertex, std::uint32_t normal) const {
    if (normal != none || vertex_normals_.empty()) return normal;
    return static_cast<std::uint32_t>(given_.normals.size()) + vertex;
  }

  // Of a target that moves all.
  std::size_t floats_moved(bool with_normals) const {
    std::size_t count = 0;
    for (const Made& made : made_)
      count += made.as_written.positions.size() + (with_normals ? made.as_written.normals.size() : 0);
    return count;
  }

  void add_target(GltfMorphs& out, const Surface& base, std::span<const Point> now, bool with_normals) const {
    std::vector<Vec3> normals;
    if (with_normals) normals = deformed_normals(base, now, normals_, corner_normal_);
    for (const Made& made : made_) {
      const bool turns = with_normals && made.has_normals;
      std::vector<double> places(made.as_written.positions.begin(), made.as_written.positions.end()), turned;
      if (turns) turned.assign(made.as_written.normals.begin(), made.as_written.normals.end());
      for (std::size_t i = 0; i < made.vertices.size(); ++i) {
        const OutputVertex& v = made.vertices[i];
        const auto at = static_cast<std::ptrdiff_t>(3 * i);
        if (now[v.vertex] != positions_[v.vertex]) std::ranges::copy(now[v.vertex], places.begin() + at);
        if (!turns) continue;
        const Vec3& n = normals[normal_of(v.vertex, v.normal)];
        const double length = norm(n);
        if (n != normals_[normal_of(v.vertex, v.normal)] && length > 0)
          std::ranges::copy((1 / length) * n, turned.begin() + at);
      }
      out.add_target(made.as_written, places, turned, {});
    }
  }

  void keep_as_written(std::size_t object, const GltfJson& primitive, const Run& run) {
    Made made{{object, {document["meshes"][object]["primitives"].size()}, {}, {}, {}}, run.vertices, false};
    const GltfJson& attributes = primitive["attributes"];
    made.as_written.positions = floats_of(attributes["POSITION"]);
    made.has_normals = attributes.contains("NORMAL");
    if (made.has_normals) made.as_written.normals = floats_of(attributes["NORMAL"]);
    made_.push_back(std::move(made));
  }

  std::vector<float> floats_of(std::size_t accessor) const {
    const GltfJson& view =
        document["bufferViews"][document["accessors"][accessor]["bufferView"].get<std::size_t>()];
    std::vector<float> values(view["byteLength"].get<std::size_t>() / sizeof(float));
    std::memcpy(values.data(), bytes.data() + view["byteOffset"].get<std::size_t>(),
                values.size() * sizeof(float));
    return values;
  }

  void add_node(std::size_t number, const std::string& name) {
    document["scenes"][0]["nodes"].push_back(number);
    document["nodes"].push_back({{"mesh", number}});
    document["meshes"].push_back({{"primitives", GltfJson::array()}});
    if (!name.empty()) document["nodes"].back()["name"] = document["meshes"].back()["name"] = name;
  }

  // Groups of one object and material that are smooth, or flat, are one primitive.
  void add_primitives() {
    std::map<std::tuple<std::uint32_t, std::uint32_t, bool>, Run> runs;
    std::size_t t = 0, g = 0;
    for_each_triangle(surface_, [&](const Triangle& triangle, const Triangle& corners) {
      const std::uint32_t polygon = surface_.triangle_polygon[t++];
      while (g + 1 < given_.groups.size() && given_.groups[g + 1].first_polygon <= polygon) ++g;
      Run& run = runs[{objects_.of_group[g], given_.groups[g].material, given_.groups[g].smooth}];
      const std::uint32_t color = color_of(polygon);
      for (std::size_t k = 0; k < 3; ++k) add_corner(run, triangle[k], corners[k], color);
    });
    if (runs.empty()) {
      Run& points = runs[{0, none, true}];
      for (std::uint32_t v = 0; v < positions_.size(); ++v) points.vertices.push_back({v, none, none, none});
    }
    for (const auto& [key, run] : runs) {
      const auto& [object, material, smooth] = key;
      GltfJson primitive = primitive_of(run, material, smooth);
      if (animated_) keep_as_written(object, primitive, run);
      document["meshes"][object]["primitives"].push_back(std::move(primitive));
    }
  }

  // Of a face: the first one with this colour stands for all. Colours of vertices go before.
  std::uint32_t color_of(std::uint32_t polygon) {
    if (given_.polygon_colors.empty() || !given_.colors.empty()) return none;
    return first_with_color_.try_emplace(given_.polygon_colors[polygon], polygon).first->second;
  }

  void add_corner(Run& run, std::uint32_t vertex, std::uint32_t corner, std::uint32_t color) const {
    const OutputVertex v{vertex, given_.corner_texture.empty() ? none : given_.corner_texture[corner],
                         given_.corner_normal.empty() ? none : given_.corner_normal[corner], color};
    const auto [at, added] = run.numbers.try_emplace(v, static_cast<std::uint32_t>(run.vertices.size()));
    if (added) run.vertices.push_back(v);
    run.indices.push_back(at->second);
  }

  GltfJson primitive_of(const Run& run, std::uint32_t material, bool smooth) {
    GltfJson primitive = {{"attributes", GltfJson::object()}};
    GltfJson& attributes = primitive["attributes"];
    const auto has = [&](std::uint32_t OutputVertex::*part) {
      return std::any_of(run.vertices.begin(), run.vertices.end(),
                         [&](const auto& v) { return v.*part != none; });
    };
    attributes["POSITION"] = add_vectors(run, 3, [&](const OutputVertex& v, float* to) {
      check_written("glTF", v.vertex, positions_[v.vertex], largest_float);
      for (std::size_t k = 0; k < 3; ++k) to[k] = static_cast<float>(positions_[v.vertex][k]);
    });
    if (!run.indices.empty() && (has(&OutputVertex::normal) || smooth)) {
      if (vertex_normals_.empty()) compute_normals();
      attributes["NORMAL"] = add_vectors(run, 3, [&](const OutputVertex& v, float* to) {
        const Vec3& n = v.normal == none ? vertex_normals_[v.vertex] : given_.normals[v.normal];
        const double length = norm(n);
        for (std::size_t k = 0; k < 3; ++k) to[k] = static_cast<float>(length > 0 ? n[k] / length : k == 2);
      });
    }
    if (has(&OutputVertex::texture)) {
      attributes["TEXCOORD_0"] = add_vectors(run, 2, [&](const OutputVertex& v, float* to) {
        const Vec2 p = v.texture == none ? Vec2{0, 0} : given_.texture_points[v.texture];
        to[0] = static_cast<float>(p[0]), to[1] = static_cast<float>(1 - p[1]);
      });
    }
    if (!given_.colors.empty() || has(&OutputVertex::color)) {
      attributes["COLOR_0"] = add_vectors(run, 4, [&](const OutputVertex& v, float* to) {
        const auto c =
            linear_of_srgb(v.color == none ? given_.colors[v.vertex] : given_.polygon_colors[v.color]);
        for (std::size_t k = 0; k < 4; ++k) to[k] = static_cast<float>(c[k]);
      });
    }
    if (run.indices.empty()) {
      primitive["mode"] = gltf_points;
    } else {
      primitive["indices"] =
          add_accessor(run.indices.data(), run.indices.size(), 1, gltf_unsigned_int, gltf_element_buffer);
    }
    if (material < given_.materials.size()) primitive["material"] = material;
    return primitive;
  }

  void compute_normals() {
    vertex_normals_.resize(positions_.size());
    const Adjacency around = vertex_triangles(positions_.size(), surface_.triangles);
    vertex_normals(positions_, surface_.triangles, around, 0, positions_.size(), vertex_normals_);
  }

  template <class Fill>
  std::size_t add_vectors(const Run& run, std::size_t components, const Fill& fill) {
    std::vector<float> values(run.vertices.size() * components);
    for (std::size_t i = 0; i < run.vertices.size(); ++i) fill(run.vertices[i], &values[i * components]);
    const std::size_t accessor =
        add_accessor(values.data(), run.vertices.size(), components, gltf_float, gltf_array_buffer);
    if (accessor == 0 || components == 3) add_bounds(document["accessors"][accessor], values, components);
    return accessor;
  }

  static void add_bounds(GltfJson& accessor, const std::vector<float>& values, std::size_t components) {
    std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(components)),
        high = low;
    for (std::size_t i = 0; i < values.size(); ++i) {
      low[i % components] = std::min(low[i % components], values[i]);
      high[i % components] = std::max(high[i % components], values[i]);
    }
    accessor["min"] = low;
    accessor["max"] = high;
  }

  std::size_t add_view(std::string_view data) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}});
    bytes.append(data);
    return document["bufferViews"].size() - 1;
  }

  std::size_t add_accessor(const void* data, std::size_t count, std::size_t components, int type,
                           int target) {
    static constexpr const char* types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const std::size_t view = add_view({static_cast<const char*>(data), 4 * count * components});
    document["bufferViews"][view]["target"] = target;
    document["accessors"].push_back(
        {{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", types[components]}});
    return document["accessors"].size() - 1;
  }

  void add_materials() {
    std::map<std::uint32_t, std::size_t> textures;
    for (const Material& m : given_.materials) {
      GltfJson json;
      if (!m.name.empty()) json["name"] = m.name;
      GltfJson& look = json["pbrMetallicRoughness"];
      look = {
          {"baseColorFactor", linear_of_srgb(m.base_color)}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}};
      if (m.base_color_image < given_.images.size()) {
        if (!textures.count(m.base_color_image)) textures[m.base_color_image] = add_texture(m);
        if (textures[m.base_color_image] != std::size_t{none})
          look["baseColorTexture"] = {{"index", textures[m.base_color_image]}};
      }
      if (m.base_color[3] < 1) json["alphaMode"] = "BLEND";
      document["materials"].push_back(std::move(json));
    }
  }

  // none: the image lies not within, or is of a kind that glTF does not know.
  std::size_t add_texture(const Material& material) {
    const ImageFile& image = given_.images[material.base_color_image];
    if (!image.bytes) return none;
    const std::string& data = *image.bytes;
    const std::string_view type = mime_type_of(data);
    if (type.empty()) return none;
    const std::size_t view = add_view(data);
    document["images"].push_back({{"bufferView", view}, {"mimeType", type}});
    const std::string name = image.path.empty() ? image.name : image.path.stem().string();
    if (!name.empty()) document["images"].back()["name"] = name;
    document["samplers"].push_back(
        {{"wrapS", material.repeats ? 10497 : 33071}, {"wrapT", material.repeats ? 10497 : 33071}});
    document["textures"].push_back(
        {{"source", document["images"].size() - 1}, {"sampler", document["samplers"].size() - 1}});
    return document["textures"].size() - 1;
  }

  const Surface& surface_;
  std::span<const Point> positions_;
  Attributes given_;
  Objects objects_;
  std::map<Color, std::uint32_t> first_with_color_;
  std::vector<Vec3> vertex_normals_;  // computed for corners without
  bool animated_;
  std::vector<Made> made_;  // of what is animated
  std::vector<Vec3> normals_;
  std::vector<std::uint32_t> corner_normal_;
};

// Names of other files may hold bytes that are not UTF-8.
std::string json_text(const GltfJson& document, int indent = -1) {
  return document.dump(indent, ' ', false, GltfJson::error_handler_t::replace);
}

void put_word(std::uint64_t word, TextWriter& out) {
  char bytes[4];
  for (char& byte : bytes) byte = static_cast<char>(word & 255), word >>= 8;
  out.text({bytes, 4});
}

std::size_t padded_to_four(std::size_t size) {
  return (size + 3) / 4 * 4;
}

// Chunks end at multiples of four bytes, JSON with blanks.
void put_chunk(std::string_view bytes, std::string_view kind, char padding, TextWriter& out) {
  constexpr std::size_t portion = 1 << 20;
  put_word(padded_to_four(bytes.size()), out);
  out.text(kind);
  for (std::size_t at = 0; at < bytes.size(); at += portion) {
    out.text(bytes.substr(at, portion));
    out.element_done(std::min(at + portion, bytes.size()), bytes.size());
  }
  out.text(std::string(padded_to_four(bytes.size()) - bytes.size(), padding));
}

void put_made(GltfMaker& made, bool binary, TextWriter& out) {
  if (binary) return write_glb_chunks(json_text(made.document), made.bytes, {}, out);
  made.document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base::base64(made.bytes);
  out.text(json_text(made.document, 2)).text("\n");
}

}  // namespace

void write_glb(const Content& content, TextWriter& out) {
  GltfMaker made(content);
  put_made(made, true, out);
}

void write_gltf(const Content& content, TextWriter& out) {
  GltfMaker made(content);
  put_made(made, false, out);
}

void write_gltf_animated(const Content& content, const MorphMotion& motion, bool binary, TextWriter& out,
                         base::Progress* progress) {
  GltfMaker made(content, true);
  made.animate(motion, progress);
  put_made(made, binary, out);
}

void write_glb_chunks(std::string_view json, std::string_view bytes, std::string_view others,
                      TextWriter& out) {
  const std::size_t binary = bytes.empty() ? 0 : 8 + padded_to_four(bytes.size());
  const std::size_t all = 20 + padded_to_four(json.size()) + binary + others.size();
  if (all > std::numeric_limits<std::uint32_t>::max())
    throw base::Error("", "more than 4 GB, which a GLB file cannot hold", "write .gltf or another format");
  out.text("glTF");
  put_word(2, out);
  put_word(all, out);
  put_chunk(json, {"JSON", 4}, ' ', out);
  if (!bytes.empty()) put_chunk(bytes, {"BIN\0", 4}, '\0', out);
  out.text(others);
}

}  // namespace viete::mesh
