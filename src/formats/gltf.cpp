#include "formats/codecs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "formats/gltf_morphs.h"
#include "formats/gltf_original.h"
#include "formats/materials.h"
#include "formats/surface_builder.h"
#include "mesh/point_index.h"

namespace viete::formats {

namespace {

constexpr std::size_t instanced_vertices = std::size_t{1} << 22;

Color srgb_color(std::span<const double> c) {
  const double opacity = c.size() > 3 ? std::clamp(c[3], 0.0, 1.0) : 1.0;
  return {srgb_of_linear(c[0]), srgb_of_linear(c[1]), srgb_of_linear(c[2]), static_cast<float>(opacity)};
}

// Settings of the extension KHR_texture_transform.
struct TextureTransform {
  Vec2 offset{0, 0}, scale{1, 1};
  double rotation = 0;
  int set = 0;

  friend bool operator==(const TextureTransform&, const TextureTransform&) = default;

  Vec2 operator()(const Vec2& p) const {
    const double x = scale[0] * p[0], y = scale[1] * p[1], c = std::cos(rotation), s = std::sin(rotation);
    return {c * x + s * y + offset[0], -s * x + c * y + offset[1]};
  }
};

TextureTransform transform_of(const GltfJson& texture) {
  TextureTransform transform;
  transform.set = std::max(0, index_of(texture, "texCoord"));
  const GltfJson& given = member_of(member_of(texture, "extensions"), "KHR_texture_transform");
  const auto take = [&](const char* key, Vec2& pair) {
    const GltfJson& value = list_of(given, key);
    for (std::size_t k = 0; k < 2 && value.size() == 2 && value[k].is_number(); ++k)
      pair[k] = value[k].get<double>();
  };
  take("offset", transform.offset);
  take("scale", transform.scale);
  const GltfJson& rotation = member_of(given, "rotation");
  if (rotation.is_number()) transform.rotation = rotation.get<double>();
  if (const int set = index_of(given, "texCoord"); set >= 0) transform.set = set;
  return transform;
}

class GltfReader {
public:
  GltfReader(const Source& source, GltfFile file)
      : source_(source), file_(std::move(file)), accessors_(file_), builder_(source) {}

  ReadResult read() {
    for (const std::string& warning : file_.warnings) builder_.warn(warning);
    take_materials();
    for (const GltfBuffer& buffer : file_.buffers) budget_ += buffer.bytes.size();
    map_.placements = placements_of(file_);
    for (std::size_t i = 0; i < map_.placements.size(); ++i) {
      source_.report(static_cast<double>(i) / static_cast<double>(map_.placements.size()));
      place_mesh(i);
    }
    warn_about_ignored_content();
    drop_unused_attributes();
    ReadResult result = builder_.finish(file_.binary ? "glTF binary" : "glTF", std::move(attributes_));
    result.original = gltf_original(source_, std::move(file_), std::move(map_));
    return result;
  }

private:
  using PieceKey = std::tuple<int, int, int, int, int>;

  void take_materials() {
    auto& images = attributes_.images;
    for (const GltfImage& image : file_.images) {
      images.push_back(image.file);
      if (image.file.name.empty()) images.back().name = "image " + std::to_string(images.size() - 1);
    }
    for (const GltfJson& m : list_of(file_.document, "materials"))
      attributes_.materials.push_back(material_of(m));
  }

  Material material_of(const GltfJson& m) {
    const GltfJson& surface = member_of(m, "pbrMetallicRoughness");
    Material material{text_of(m, "name"), color_of(surface, "baseColorFactor", {1, 1, 1, 1})};
    material.emission = color_of(m, "emissiveFactor", {0, 0, 0, 1});
    for (const MaterialNumber& property : material_numbers) {
      const GltfJson& value = member_of(surface, property.gltf);
      material.*property.number = value.is_number() ? std::clamp(value.get<float>(), 0.0F, 1.0F) : 1;
    }
    const std::string alpha = text_of(m, "alphaMode");
    material.is_translucent = alpha == "BLEND" || alpha == "MASK";
    if (!material.is_translucent) material.base_color[3] = 1;
    const TextureTransform transform = transform_of_material(m);
    for (const MaterialImage& property : material_images) {
      const GltfJson& texture = texture_of(m, property);
      if (texture.is_null()) continue;
      if (transform_of(texture) == transform)
        take_texture(index_of(texture, "index"), material, property);
      else
        file_.has_other_coordinates = true;
    }
    return material;
  }

  static Color color_of(const GltfJson& of, const char* key, const Color& otherwise) {
    std::vector<double> color;
    for (const GltfJson& value : list_of(of, key))
      color.push_back(value.is_number() ? value.get<double>() : 0);
    return color.size() >= 3 ? srgb_color(color) : otherwise;
  }

  static const GltfJson& texture_of(const GltfJson& material, const MaterialImage& property) {
    return member_of(property.gltf_parent ? member_of(material, property.gltf_parent) : material,
                     property.gltf);
  }

  // Returns the transform of the first texture.
  static TextureTransform transform_of_material(const GltfJson& material) {
    for (const MaterialImage& property : material_images)
      if (const GltfJson& texture = texture_of(material, property); !texture.is_null())
        return transform_of(texture);
    return {};
  }

  // Returns the index of the texture's image, perhaps from an extension, or -1 if the image is missing.
  static int source_of(const GltfJson& texture) {
    const int source = index_of(texture, "source");
    const GltfJson& webp = member_of(member_of(texture, "extensions"), "EXT_texture_webp");
    return source < 0 ? index_of(webp, "source") : source;
  }

  void take_texture(int index, Material& material, const MaterialImage& property) {
    const GltfJson& texture = element_of(file_.document, "textures", index);
    const int source = source_of(texture);
    if (source < 0) is_basis_ |= !member_of(member_of(texture, "extensions"), "KHR_texture_basisu").is_null();
    if (source < 0 || static_cast<std::size_t>(source) >= file_.images.size()) return;
    material.*property.image = static_cast<std::uint32_t>(source);
    const GltfJson& sampler = element_of(file_.document, "samplers", index_of(texture, "sampler"));
    material.repeats = index_of(sampler, "wrapS") != gltf_clamp_to_edge;
  }

  void place_mesh(std::size_t placement) {
    const GltfPlacement& p = map_.placements[placement];
    const GltfJson& mesh = element_of(file_.document, "meshes", p.mesh);
    pieces_.clear();
    const std::size_t first = points_.size(), first_corner = map_.corner_vertex.size();
    take_weights(p, mesh);
    for (const GltfJson& primitive : list_of(mesh, "primitives")) {
      if (accessor_of(primitive, "POSITION") < 0) continue;  // glTF does not draw this primitive
      add_group(p, mesh, primitive);
      add_polygons(primitive, piece_of(placement, primitive), p.map.determinant() < 0);
    }
    weld(first, first_corner);
  }

  // Sets weights_ to the default weights of the morph targets. If all weights are 0, weights_ becomes empty.
  void take_weights(const GltfPlacement& p, const GltfJson& mesh) {
    std::size_t count = 0;
    for (const GltfJson& primitive : list_of(mesh, "primitives"))
      count = std::max(count, list_of(primitive, "targets").size());
    spend(count);
    weights_ = default_weights(file_.document, p, count);
    if (std::ranges::all_of(weights_, [](double w) { return w == 0; })) weights_.clear();
    morphs_ |= count > 0;
    is_shaped_ |= !weights_.empty();
    shaped_.clear();
  }

  // Caches the list, because many nodes can place the same mesh.
  std::shared_ptr<const std::vector<GltfTarget>> targets_of(const GltfJson& primitive) {
    auto& targets = targets_[&primitive];
    if (targets) return targets;
    std::vector<GltfTarget> all;
    for (const GltfJson& target : list_of(primitive, "targets"))
      all.push_back({index_of(target, "POSITION"), index_of(target, "NORMAL"), index_of(target, "TANGENT")});
    return targets = std::make_shared<const std::vector<GltfTarget>>(std::move(all));
  }

  // Returns offsets of positions or normals at the default weights. If all weights are 0, the list is empty.
  std::vector<double> differences(int GltfTarget::*of) {
    const GltfPiece& piece = map_.pieces.back();
    for (const double weight : weights_) spend(weight == 0 ? 0 : piece.count);
    return morph_differences(accessors_, piece, of, weights_);
  }

  void add_group(const GltfPlacement& p, const GltfJson& mesh, const GltfJson& primitive) {
    const std::string node = text_of(element_of(file_.document, "nodes", p.node), "name");
    Group group;
    group.first_polygon = polygons_;
    group.object = node.empty() ? text_of(mesh, "name") : node;
    const int material = index_of(primitive, "material");
    if (!element_of(file_.document, "materials", material).is_null())
      group.material = static_cast<std::uint32_t>(material);
    group.smooth = accessor_of(primitive, "NORMAL") >= 0;
    auto& groups = attributes_.groups;
    if (!groups.empty() && groups.back().first_polygon == polygons_)
      groups.pop_back();  // the previous group has no polygons
    groups.push_back(group);
  }

  // Returns the index of the material if the material transforms texture coordinates, otherwise -1.
  // Primitives with different results get separate vertices.
  static int mover_of(const GltfJson& primitive, const TextureTransform& transform) {
    return transform == TextureTransform{.set = transform.set} ? -1 : index_of(primitive, "material");
  }

  struct Piece {
    std::size_t first = 0, count = 0;
    bool has_texture = false, has_normals = false;
  };

  Piece piece_of(std::size_t placement, const GltfJson& primitive) {
    const TextureTransform transform =
        transform_of_material(element_of(file_.document, "materials", index_of(primitive, "material")));
    const int texture = accessor_of(primitive, ("TEXCOORD_" + std::to_string(transform.set)).c_str());
    const int normals = accessor_of(primitive, "NORMAL"), colors = accessor_of(primitive, "COLOR_0");
    const int positions = accessor_of(primitive, "POSITION"), tangents = accessor_of(primitive, "TANGENT");
    const PieceKey key{positions, normals, tangents, texture, mover_of(primitive, transform)};
    if (const auto found = pieces_.find(key); found != pieces_.end()) return found->second;
    Piece piece{points_.size(), accessors_.count(positions), texture >= 0, normals >= 0};
    spend(piece.count);
    map_.pieces.push_back(
        {placement, piece.first, piece.count, positions, normals, tangents, targets_of(primitive)});
    const AffineMap& map = map_.placements[placement].map;
    add_points(positions, map);
    add_texture(piece, texture, transform);
    add_normals(piece, normals, map);
    add_colors(piece, colors);
    if (tangents >= 0) matching(piece, tangents, 4);
    return pieces_[key] = piece;
  }

  // Limits the number of vertices and corners, because a small file can contain many instances.
  void spend(std::size_t elements) {
    spent_ += elements;
    if (spent_ > budget_ + instanced_vertices)
      throw base::Error(file_.name,
                        "copies of meshes or of their morph targets add more than 4 million vertices",
                        "export fewer instances");
  }

  void add_points(int accessor, const AffineMap& map) {
    std::vector<double> numbers = accessors_.numbers(accessor, 3);
    add_points(accessor, map, numbers, points_);
    if (weights_.empty()) return;
    const std::vector<double> added = differences(&GltfTarget::positions);
    for (std::size_t i = 0; i < added.size(); ++i) numbers[i] += added[i];
    add_points(accessor, map, numbers, shaped_);
  }

  void add_points(int accessor, const AffineMap& map, const std::vector<double>& numbers,
                  std::vector<mesh::Point>& points) const {
    const bool moves = !map.is_identity();
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
      mesh::Point p{numbers[i], numbers[i + 1], numbers[i + 2]};
      if (moves) p = map.of_point(p);
      if (!is_place(p))
        accessors_.fail("accessor", accessor,
                        "position " + std::to_string(i / 3) + " is not a finite number up to 1e100");
      points.push_back(p);
    }
  }

  std::vector<double> matching(const Piece& piece, int accessor, std::size_t components) const {
    if (accessors_.count(accessor) != piece.count)
      accessors_.fail("accessor", accessor,
                      "has " + std::to_string(accessors_.count(accessor)) + " elements for " +
                          std::to_string(piece.count) + " positions");
    return accessors_.numbers(accessor, components);
  }

  // In glTF, v = 0 is the top row of the image. In Attributes, v = 0 is the bottom row.
  void add_texture(const Piece& piece, int accessor, const TextureTransform& transform) {
    attributes_.texture_points.resize(piece.first + piece.count, Vec2{0, 0});
    if (accessor < 0) return;
    const std::vector<double> numbers = matching(piece, accessor, 2);
    for (std::size_t i = 0; i < piece.count; ++i) {
      const Vec2 p = transform({numbers[2 * i], numbers[2 * i + 1]});
      if (std::isfinite(p[0] + p[1])) attributes_.texture_points[piece.first + i] = {p[0], 1 - p[1]};
    }
    has_texture_ = true;
  }

  void add_normals(const Piece& piece, int accessor, const AffineMap& map) {
    attributes_.normals.resize(piece.first + piece.count, mesh::Vec3{0, 0, 0});
    if (accessor < 0) return;
    std::vector<double> numbers = matching(piece, accessor, 3);
    const std::vector<double> added =
        source_.played ? std::vector<double>() : differences(&GltfTarget::normals);
    for (std::size_t i = 0; i < added.size(); ++i) numbers[i] += added[i];
    const bool turns = !map.is_identity() || !added.empty();
    for (std::size_t i = 0; i < piece.count; ++i) {
      mesh::Vec3 n{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
      if (turns) n = map.of_normal(n);
      if (turns && mesh::norm(n) > 0) n = (1 / mesh::norm(n)) * n;
      if (std::isfinite(n[0] + n[1] + n[2])) attributes_.normals[piece.first + i] = n;
    }
    has_normals_ = true;
  }

  void add_colors(const Piece& piece, int accessor) {
    colors_.resize(piece.first + piece.count, Color{1, 1, 1, 1});
    if (accessor < 0) return;
    const std::size_t components = accessors_.components(accessor) == 4 ? 4 : 3;
    const std::vector<double> numbers = matching(piece, accessor, components);
    for (std::size_t i = 0; i < piece.count; ++i)
      colors_[piece.first + i] = srgb_color(std::span(numbers).subspan(components * i, components));
    has_colors_ = true;
  }

  void add_polygons(const GltfJson& primitive, const Piece& piece, bool mirrored) {
    const std::uint64_t mode = count_of(primitive, "mode").value_or(gltf_triangles);
    const bool strip = mode == gltf_strip, fan = mode == gltf_fan;
    if (mode != gltf_triangles && !strip && !fan) return void(++unseen_primitives_);
    const int indices = index_of(primitive, "indices");
    std::vector<std::uint32_t> list;
    if (indices >= 0) list = accessors_.indices(indices, piece.count);
    const std::size_t n = indices >= 0 ? list.size() : piece.count;
    const auto vertex = [&](std::size_t i) { return list.empty() ? static_cast<std::uint32_t>(i) : list[i]; };
    spend(n);
    if (!strip && !fan) {
      for (std::size_t i = 0; i + 2 < n; i += 3)
        add_triangle(piece, {vertex(i), vertex(i + 1), vertex(i + 2)}, mirrored);
      return;
    }
    for (std::size_t i = 0; i + 2 < n; ++i) {
      const mesh::Triangle t = fan ? mesh::Triangle{vertex(0), vertex(i + 1), vertex(i + 2)}
                                   : mesh::Triangle{vertex(i), vertex(i + 1 + i % 2), vertex(i + 2 - i % 2)};
      const bool joins_strips = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
      if (!joins_strips) add_triangle(piece, t, mirrored);
    }
  }

  void add_triangle(const Piece& piece, mesh::Triangle t, bool mirrored) {
    if (mirrored) std::swap(t[1], t[2]);
    for (const std::uint32_t v : t) {
      const auto vertex = static_cast<std::uint32_t>(piece.first + v);
      map_.corner_vertex.push_back(vertex);
      attributes_.corner_texture.push_back(piece.has_texture ? vertex : mesh::none);
      attributes_.corner_normal.push_back(piece.has_normals ? vertex : mesh::none);
    }
    ++polygons_;
  }

  // For each vertex from `first`, returns the first vertex that has the same position, both at rest and with
  // the default weights. The returned indices count from `first`.
  std::vector<std::uint32_t> lowest_vertices(std::size_t first) const {
    auto lowest = mesh::lowest_in_place(std::span(points_).subspan(first));
    if (shaped_.empty()) return lowest;
    const auto shaped = mesh::lowest_in_place(shaped_);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> in_both;
    for (std::uint32_t i = 0; i < lowest.size(); ++i)
      lowest[i] = in_both.try_emplace({lowest[i], shaped[i]}, i).first->second;
    return lowest;
  }

  void weld(std::size_t first, std::size_t first_corner) {
    if (points_.size() >= mesh::none)
      throw base::Error(file_.name, "the file has more than 4294967294 vertices", "split the model");
    const auto lowest = lowest_vertices(first);
    const bool is_shaped = !shaped_.empty() && !source_.played;
    map_.surface_vertex.resize(points_.size());
    for (std::size_t i = 0; i < lowest.size(); ++i) {
      if (lowest[i] != i) {
        map_.surface_vertex[first + i] = map_.surface_vertex[first + lowest[i]];
        continue;
      }
      map_.surface_vertex[first + i] = static_cast<std::uint32_t>(builder_.vertex_count());
      builder_.position(is_shaped ? shaped_[i] : points_[first + i]);
      attributes_.colors.push_back(colors_[first + i]);
    }
    for (std::size_t c = first_corner; c < map_.corner_vertex.size(); ++c) {
      builder_.corner(map_.surface_vertex[map_.corner_vertex[c]]);
      if (c % 3 == 2) builder_.end_polygon();
    }
  }

  void warn_about_ignored_content() {
    if (is_gltf_capture(file_.document)) builder_.warn(capture_note);
    if (unseen_primitives_ > 0)
      builder_.warn(base::counted(unseen_primitives_, "primitive") +
                    " of points or lines: deformed, but not drawn");
    if (is_basis_)
      builder_.warn("Basis textures (KHR_texture_basisu) are not shown; export PNG or JPEG textures");
    if (morphs_ && !source_.played && has_animation(file_.document, true))
      builder_.warn(is_shaped_ ? "morph targets keep their default weights; their animation is ignored"
                               : "the animation of morph targets is ignored");
  }

  void drop_unused_attributes() {
    Attributes& a = attributes_;
    if (!has_texture_) {
      a.texture_points.clear();
      a.corner_texture.clear();
    }
    if (!has_normals_) {
      a.normals.clear();
      a.corner_normal.clear();
    }
    if (!has_colors_) a.colors.clear();
    if (!a.groups.empty() && a.groups.back().first_polygon == polygons_) a.groups.pop_back();
  }

  const Source& source_;
  GltfFile file_;
  GltfAccessors accessors_;
  SurfaceBuilder builder_;
  Attributes attributes_;
  GltfMap map_;
  std::vector<mesh::Point> points_;  // one per vertex of the file, in scene coordinates
  std::vector<Color> colors_;        // one per vertex of the file
  std::map<PieceKey, Piece> pieces_;
  std::map<const GltfJson*, std::shared_ptr<const std::vector<GltfTarget>>> targets_;  // for each primitive
  std::vector<double> weights_;      // weights of the current placement's targets; empty if all are 0
  std::vector<mesh::Point> shaped_;  // points of this placement with weights_; empty if weights_ is empty
  std::size_t budget_ = 0, spent_ = 0, unseen_primitives_ = 0;
  std::uint32_t polygons_ = 0;
  bool has_texture_ = false, has_normals_ = false, has_colors_ = false, morphs_ = false, is_shaped_ = false,
       is_basis_ = false;
};

}  // namespace

bool looks_like_gltf(const Source& source) {
  if (source.bytes.starts_with("glTF")) return true;
  const auto first = source.bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return first != std::string_view::npos && source.bytes[first] == '{' &&
         source.bytes.find("\"asset\"") != std::string_view::npos;
}

bool is_certainly_gltf(const Beginning& file) {
  using namespace std::string_view_literals;
  if (file.bytes().starts_with("glTF\2\0\0\0"sv))
    return file.bytes().size() >= 20 && file.bytes().substr(16, 4) == "JSON"sv;
  return text_in_json(file.bytes(), {"asset", "version"}).starts_with("2.");
}

ReadResult read_gltf(const Source& source) {
  return GltfReader(source, take_apart(source)).read();
}

}  // namespace viete::formats
