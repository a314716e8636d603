#include "mesh/gltf_original.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/quantity.h"
#include "mesh/gltf_accessors.h"
#include "mesh/gltf_beyond.h"
#include "mesh/gltf_output.h"
#include "mesh/normals.h"

namespace viete::mesh {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The file with other positions, before it is put into one form or the other.
class GltfRewriter {
public:
  GltfRewriter(const GltfFile& file, const GltfMap& map, const Surface& rest,
               std::span<const Point> positions)
      : file_(file),
        map_(map),
        rest_(rest),
        posed_(positions),
        model_(parse_gltf(file)),
        accessors_(file, *model_),
        document_(Json::parse(file.json)) {
    for (const GltfBuffer& buffer : file.buffers) buffers_.push_back(buffer.bytes);
    for (const GltfPiece& piece : map.pieces) {
      if (moves(piece)) moved_.push_back(&piece);
    }
    if (!moved_.empty()) rewrite();
  }

  Json& document() { return document_; }
  std::vector<std::string>& buffers() { return buffers_; }
  std::vector<std::string> notes;

private:
  bool moves(std::size_t vertex) const {
    const std::uint32_t v = map_.surface_vertex[vertex];
    return rest_.positions[v] != posed_[v];
  }

  bool moves(const GltfPiece& piece) const {
    for (std::size_t i = 0; i < piece.count; ++i) {
      if (moves(piece.first + i)) return true;
    }
    return false;
  }

  void rewrite() {
    part_instances();
    count_uses();
    carry_vectors();
    for (const GltfPiece* piece : moved_) {
      const GltfPlacement& placement = map_.placements[piece->placement];
      const auto inverse = placement.map.inverse();
      if (!inverse)
        throw base::Error(file_.name + ": node " + std::to_string(placement.node),
                          "flattens its mesh, so that no deformation can be put back into it",
                          "apply the node's scale in a modelling program first, or write another format");
      put_positions(*piece, *inverse);
      put_normals(*piece, *inverse);
      put_tangents(*piece, *inverse);
    }
  }

  // Each node that has moved a mesh of several gets its own.
  void part_instances() {
    std::map<int, std::size_t> users;
    for (const tinygltf::Node& node : model_->nodes) ++users[node.mesh];
    std::size_t parted = 0, last = map_.placements.size();
    for (const GltfPiece* piece : moved_) {
      if (std::exchange(last, piece->placement) == piece->placement) continue;
      const GltfPlacement& placement = map_.placements[piece->placement];
      if (users[placement.mesh] < 2) continue;
      --users[placement.mesh];
      Json copy = document_["meshes"][static_cast<std::size_t>(placement.mesh)];
      document_["nodes"][static_cast<std::size_t>(placement.node)]["mesh"] = document_["meshes"].size();
      document_["meshes"].push_back(std::move(copy));
      ++parted;
    }
    if (parted > 0)
      notes.push_back(
          std::string(parted == 1 ? "1 copy" : std::to_string(parted) + " copies") +
          " of meshes that several nodes share are meshes of their own now, for each deforms differently");
  }

  // How often each accessor is named, wherever that is.
  void count_uses() {
    uses_.assign(document_["accessors"].size(), 0);
    const auto use = [&](const Json& value) {
      if (value.is_number_unsigned() && value.get<std::size_t>() < uses_.size())
        ++uses_[value.get<std::size_t>()];
    };
    const auto use_all = [&](const Json& attributes) {
      if (!attributes.is_object()) return;
      for (const auto& [key, value] : attributes.items()) use(value);
    };
    for (const Json& mesh : document_["meshes"]) {
      for (const Json& primitive : mesh.value("primitives", Json::array())) {
        use_all(primitive.value("attributes", Json::object()));
        use(primitive.value("indices", Json()));
        for (const Json& target : primitive.value("targets", Json::array())) use_all(target);
      }
    }
    for (const Json& animation : document_.value("animations", Json::array())) {
      if (!animation.is_object() || !animation.value("samplers", Json()).is_array()) continue;
      for (const Json& sampler : animation["samplers"]) use_all(sampler);
    }
    for (const Json& skin : document_.value("skins", Json::array())) {
      if (skin.is_object()) use(skin.value("inverseBindMatrices", Json()));
    }
  }

  // Normals and tangents of all vertices of the file, in the scene.
  void carry_vectors() {
    std::vector<Vec3> normals(map_.surface_vertex.size(), Vec3{0, 0, 0}), tangents = normals;
    bool has_normals = false, has_tangents = false;
    for (const GltfPiece* piece : moved_) {
      const AffineMap& map = map_.placements[piece->placement].map;
      const auto take = [&](int accessor, std::vector<Vec3>& to, auto move) {
        if (accessor < 0) return false;
        const std::vector<double> numbers = accessors_.numbers(accessor, 3);
        for (std::size_t i = 0; i < piece->count; ++i)
          to[piece->first + i] = move(Vec3{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]});
        return true;
      };
      has_normals |= take(piece->normals, normals, [&](const Vec3& n) { return map.of_normal(n); });
      has_tangents |= take(piece->tangents, tangents, [&](const Vec3& t) { return map.of_vector(t); });
    }
    if (has_normals) normals_ = deformed_normals(rest_, posed_, normals, map_.corner_vertex);
    if (has_tangents) tangents_ = deformed_tangents(rest_, posed_, tangents, map_.corner_vertex);
    unmoved_normals_ = std::move(normals);
    unmoved_tangents_ = std::move(tangents);
  }

  void put_positions(const GltfPiece& piece, const AffineMap& inverse) {
    std::vector<float> values = floats(piece.positions, 3);
    for (std::size_t i = 0; i < piece.count; ++i) {
      if (moves(piece.first + i))
        set(values, 3 * i, inverse.of_point(posed_[map_.surface_vertex[piece.first + i]]));
    }
    put(piece, "POSITION", piece.positions, 3, values);
  }

  void put_normals(const GltfPiece& piece, const AffineMap& inverse) {
    if (piece.normals < 0) return;
    std::vector<float> values = floats(piece.normals, 3);
    for (std::size_t i = 0; i < piece.count; ++i) {
      const Vec3& n = normals_[piece.first + i];
      if (n != unmoved_normals_[piece.first + i]) set(values, 3 * i, unit_or_zero(inverse.of_normal(n)));
    }
    put(piece, "NORMAL", piece.normals, 3, values);
  }

  void put_tangents(const GltfPiece& piece, const AffineMap& inverse) {
    if (piece.tangents < 0) return;
    std::vector<float> values = floats(piece.tangents, 4);
    for (std::size_t i = 0; i < piece.count; ++i) {
      const Vec3 &t = tangents_[piece.first + i], &old = unmoved_tangents_[piece.first + i];
      if (t == old) continue;
      const Vec3 n =
          piece.normals < 0 ? Vec3{0, 0, 0} : unit_or_zero(inverse.of_normal(normals_[piece.first + i]));
      const Vec3 local = inverse.of_vector(t);
      set(values, 4 * i, unit_or_zero(local - dot(local, n) * n));
    }
    put(piece, "TANGENT", piece.tangents, 4, values);
  }

  static Vec3 unit_or_zero(const Vec3& v) {
    const double length = stable_norm(v);
    return length > 0 ? (1 / length) * v : Vec3{0, 0, 0};
  }

  void set(std::vector<float>& values, std::size_t at, const Vec3& v) const {
    for (std::size_t k = 0; k < 3; ++k) {
      values[at + k] = static_cast<float>(v[k]);
      if (!std::isfinite(values[at + k]))
        throw base::Error(file_.name, "a deformed position is larger than glTF can hold",
                          "write another format");
    }
  }

  std::vector<float> floats(int accessor, std::size_t components) const {
    const std::vector<double> numbers = accessors_.numbers(accessor, components);
    return {numbers.begin(), numbers.end()};
  }

  // Into the place of the old ones, if that is theirs alone.
  void put(const GltfPiece& piece, const char* attribute, int accessor, std::size_t components,
           const std::vector<float>& values) {
    const std::vector<Json*> primitives = primitives_of(piece);
    const auto index = static_cast<std::size_t>(accessor);
    const bool in_place = uses_[index] == primitives.size() && is_alone(accessor, components);
    const std::size_t to = in_place ? index : appended(index, components, values);
    if (in_place) {
      const GltfPlace place = accessors_.place(accessor);
      for (std::size_t i = 0; i < place.count; ++i)
        std::memcpy(buffers_[place.buffer].data() + place.offset + i * place.stride, &values[i * components],
                    components * sizeof(float));
    }
    for (Json* primitive : primitives) (*primitive)["attributes"][attribute] = to;
    set_bounds(document_["accessors"][to], components, values, *attribute == 'P');
  }

  // Those of its mesh that have the piece's vertices, as the file names them.
  std::vector<Json*> primitives_of(const GltfPiece& piece) {
    const GltfPlacement& placement = map_.placements[piece.placement];
    const auto& original = model_->meshes[static_cast<std::size_t>(placement.mesh)].primitives;
    const std::size_t mesh = document_["nodes"][static_cast<std::size_t>(placement.node)]["mesh"];
    const auto names = [](const tinygltf::Primitive& p, const char* attribute, int accessor) {
      const auto found = p.attributes.find(attribute);
      return (found == p.attributes.end() ? -1 : found->second) == accessor;
    };
    std::vector<Json*> found;
    for (std::size_t i = 0; i < original.size(); ++i) {
      const tinygltf::Primitive& p = original[i];
      if (names(p, "POSITION", piece.positions) && names(p, "NORMAL", piece.normals) &&
          names(p, "TANGENT", piece.tangents))
        found.push_back(&document_["meshes"][mesh]["primitives"][i]);
    }
    return found;
  }

  struct Bytes {
    std::size_t buffer, begin, end;
  };

  static Bytes bytes_of(const GltfPlace& p) {
    return {p.buffer, p.offset, p.offset + (p.count - 1) * p.stride + p.size};
  }

  // Neighbours in an interleaved view lie between each other's elements, not over them.
  static bool interleaved(const GltfPlace& a, const GltfPlace& b) {
    if (a.stride != b.stride) return false;
    const std::size_t from = a.offset % a.stride, other = b.offset % b.stride;
    return from + a.size <= other || other + b.size <= from;
  }

  // Floats that no other accessor or image shares a byte with.
  bool is_alone(int accessor, std::size_t components) {
    const auto index = static_cast<std::size_t>(accessor);
    const tinygltf::Accessor& a = model_->accessors[index];
    const GltfPlace place = accessors_.place(accessor);
    if (!place.has_bytes || a.sparse.isSparse || a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        place.size != components * sizeof(float))
      return false;
    comparisons_ += model_->accessors.size();
    if (comparisons_ > 100'000'000) return false;  // a file made to take long
    const Bytes mine = bytes_of(place);
    for (std::size_t i = 0; i < model_->accessors.size(); ++i) {
      if (i == index || uses_[i] == 0) continue;
      const auto other = place_if_sound(static_cast<int>(i));
      if (!other) continue;
      const Bytes theirs = bytes_of(*other);
      if (theirs.buffer == mine.buffer && theirs.begin < mine.end && mine.begin < theirs.end &&
          !interleaved(place, *other))
        return false;
    }
    return !meets_image(mine);
  }

  std::optional<GltfPlace> place_if_sound(int accessor) const {
    try {
      const GltfPlace place = accessors_.place(accessor);
      if (place.has_bytes) return place;
    } catch (const base::Error&) {  // what nobody reads need not be sound
    }
    return std::nullopt;
  }

  bool meets_image(const Bytes& mine) const {
    for (const Json& image : document_.value("images", Json::array())) {
      if (!image.is_object() || !image.value("bufferView", Json()).is_number_unsigned()) continue;
      const std::size_t view = image["bufferView"];
      if (view >= model_->bufferViews.size()) continue;
      const tinygltf::BufferView& v = model_->bufferViews[view];
      if (v.buffer == static_cast<int>(mine.buffer) && v.byteOffset < mine.end &&
          mine.begin < v.byteOffset + v.byteLength)
        return true;
    }
    return false;
  }

  // A new accessor like the old one, over new bytes at the end of its buffer.
  std::size_t appended(std::size_t old, std::size_t components, const std::vector<float>& values) {
    const GltfPlace place = accessors_.place(static_cast<int>(old));
    std::string& bytes = buffers_[place.buffer];
    bytes.resize((bytes.size() + 3) / 4 * 4);
    Json& views = document_["bufferViews"];
    Json view = {{"buffer", place.buffer},
                 {"byteOffset", bytes.size()},
                 {"byteLength", values.size() * sizeof(float)},
                 {"target", TINYGLTF_TARGET_ARRAY_BUFFER}};
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    Json accessor = document_["accessors"][old];
    for (const char* key : {"sparse", "byteOffset", "normalized"}) accessor.erase(key);
    accessor["bufferView"] = views.size();
    accessor["componentType"] = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor["type"] = components == 4 ? "VEC4" : "VEC3";
    views.push_back(std::move(view));
    document_["accessors"].push_back(std::move(accessor));
    return document_["accessors"].size() - 1;
  }

  // Positions must have bounds; of others they are only corrected.
  static void set_bounds(Json& accessor, std::size_t components, const std::vector<float>& values,
                         bool must) {
    if (!must && !accessor.contains("min") && !accessor.contains("max")) return;
    std::vector<float> low(components, std::numeric_limits<float>::max()), high(components, -low[0]);
    for (std::size_t i = 0; i < values.size(); ++i) {
      low[i % components] = std::min(low[i % components], values[i]);
      high[i % components] = std::max(high[i % components], values[i]);
    }
    accessor["min"] = low;
    accessor["max"] = high;
  }

  const GltfFile& file_;
  const GltfMap& map_;
  const Surface& rest_;
  std::span<const Point> posed_;
  std::shared_ptr<const tinygltf::Model> model_;
  GltfAccessors accessors_;
  Json document_;
  std::vector<std::string> buffers_;
  std::vector<const GltfPiece*> moved_;
  std::vector<std::size_t> uses_;
  std::vector<Vec3> normals_, tangents_, unmoved_normals_, unmoved_tangents_;
  std::size_t comparisons_ = 0;
};

class GltfOriginal final : public Original {
public:
  GltfOriginal(const Source& source, GltfFile file, GltfMap map)
      : owner_(source.owner),
        bytes_(source.owner ? source.bytes : std::string_view()),
        file_(std::move(file)),
        map_(std::move(map)) {}

  bool writes(std::string_view extension) const override { return extension == "gltf" || extension == "glb"; }
  std::vector<std::string> beyond_attributes() const override { return mesh::beyond_attributes(file_); }

  // In one piece.
  std::vector<std::string> write(const Surface& rest, std::span<const Point> positions,
                                 TextWriter& out) const override {
    if (is_at_rest(rest, positions)) return out.text(bytes_), std::vector<std::string>();
    GltfRewriter result(file_, map_, rest, positions);
    const std::size_t first_in_text = file_.binary ? 1 : 0;
    for (std::size_t i = first_in_text; i < result.buffers().size(); ++i)
      embed(result.document(), i, result.buffers()[i]);
    if (file_.binary) {
      if (!result.buffers().empty()) result.document()["buffers"][0].erase("uri");
      write_glb(result.document(), result.buffers(), out);
    } else {
      set_lengths(result.document(), result.buffers());
      out.text(result.document().dump(2)).text("\n");
    }
    return std::move(result.notes);
  }

  std::vector<std::string> write_file(const fs::path& path, const Surface& rest,
                                      std::span<const Point> positions, Digits /*floats have none*/,
                                      base::Progress* progress) const override {
    const bool same_form = file_.binary == (extension_of(path) == "glb");
    if (same_form && leads_nowhere() && is_at_rest(rest, positions)) {
      base::replace_file(path, bytes_);
      return {};
    }
    GltfRewriter result(file_, map_, rest, positions);
    lead_images(path, result.document(), result.notes);
    const bool binary = extension_of(path) == "glb";
    for (std::size_t i = 0; i < result.buffers().size(); ++i) {
      if (binary && i == 0) {
        result.document()["buffers"][0].erase("uri");
      } else if (binary || file_.buffers[i].home == GltfBuffer::Home::text) {
        embed(result.document(), i, result.buffers()[i]);
      } else {
        write_beside(path, i, result.document(), result.buffers()[i]);
      }
    }
    base::replace_file(path, [&](const base::ByteSink& sink) {
      TextWriter out(sink, progress);
      set_lengths(result.document(), result.buffers());
      if (binary) {
        write_glb(result.document(), result.buffers(), out);
      } else {
        out.text(result.document().dump(2)).text("\n");
      }
      out.finish();
    });
    return std::move(result.notes);
  }

private:
  bool is_at_rest(const Surface& rest, std::span<const Point> positions) const {
    return !bytes_.empty() && std::ranges::equal(rest.positions, positions);
  }

  // Neither to buffers nor to images beside.
  bool leads_nowhere() const {
    return std::ranges::none_of(file_.buffers,
                                [](const GltfBuffer& b) { return b.home == GltfBuffer::Home::beside; }) &&
           std::ranges::all_of(file_.images, [](const GltfImage& i) { return i.uri.empty(); });
  }

  static void embed(Json& document, std::size_t buffer, const std::string& bytes) {
    document["buffers"][buffer]["uri"] = "data:application/octet-stream;base64," + base64(bytes);
  }

  static void set_lengths(Json& document, const std::vector<std::string>& buffers) {
    for (std::size_t i = 0; i < buffers.size(); ++i) document["buffers"][i]["byteLength"] = buffers[i].size();
  }

  static void write_glb(Json& document, const std::vector<std::string>& buffers, TextWriter& out) {
    set_lengths(document, buffers);
    write_glb_chunks(document.dump(), buffers.empty() ? std::string_view() : buffers.front(), out);
  }

  // Images beside stay where they are: from another folder they are named by the way to it.
  void lead_images(const fs::path& path, Json& document, std::vector<std::string>& notes) const {
    const fs::path from = fs::absolute(file_.name).parent_path(), to = fs::absolute(path).parent_path();
    if (from.lexically_normal() == to.lexically_normal()) return;
    std::size_t led = 0;
    for (std::size_t i = 0; i < file_.images.size(); ++i) {
      const GltfImage& image = file_.images[i];
      if (image.uri.empty() || image.file.path.empty()) continue;
      const fs::path way = image.file.path.lexically_normal().lexically_relative(to.lexically_normal());
      document["images"][i]["uri"] = encoded_uri(way.generic_string());
      ++led;
    }
    if (led > 0)
      notes.push_back(base::counted(led, "image") + " stayed where the model was read from, and " +
                      path.filename().string() + " leads there: move them together");
  }

  void write_beside(const fs::path& path, std::size_t buffer, Json& document,
                    const std::string& bytes) const {
    const std::string number = buffer == 0 ? "" : "-" + std::to_string(buffer);
    fs::path name = path.parent_path() / (path.stem().string() + number + ".bin");
    if (fs::exists(name) && !is_of_older_result(path, name)) name = base::unused_name(name);
    base::replace_file(name, bytes);
    document["buffers"][buffer]["uri"] = encoded_uri(name.filename().string());
  }

  // A file that is replaced takes its buffer with it, but for one that the model itself was read from.
  bool is_of_older_result(const fs::path& path, const fs::path& buffer) const {
    std::error_code failed;
    for (const GltfBuffer& own : file_.buffers) {
      if (!own.path.empty() && fs::equivalent(own.path, buffer, failed)) return false;
    }
    if (!fs::is_regular_file(path, failed)) return false;
    const FileBytes older(path, nullptr);
    return older.view().find('"' + encoded_uri(buffer.filename().string()) + '"') != std::string_view::npos;
  }

  std::shared_ptr<const void> owner_;
  std::string_view bytes_;
  GltfFile file_;
  GltfMap map_;
};

}  // namespace

std::shared_ptr<const Original> gltf_original(const Source& source, GltfFile file, GltfMap map) {
  return std::make_shared<GltfOriginal>(source, std::move(file), std::move(map));
}

}  // namespace viete::mesh
