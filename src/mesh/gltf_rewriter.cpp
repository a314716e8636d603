#include "mesh/gltf_rewriter.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "mesh/gltf_accessors.h"
#include "mesh/normals.h"

namespace viete::mesh {

namespace {

using Json = GltfJson;

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

  GltfRewritten take() && { return {std::move(document_), std::move(buffers_), std::move(notes_)}; }

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
    list_bytes();
    list_primitives();
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
      notes_.push_back(
          std::string(parted == 1 ? "1 copy" : std::to_string(parted) + " copies") +
          " of meshes that several nodes share are meshes of their own now, for each deforms differently");
  }

  // How often each accessor is named, wherever that is.
  void count_uses() {
    uses_.assign(document_["accessors"].size(), 0);
    const auto use = [&](const Json& value) {
      if (const auto accessor = count_of(value); accessor && *accessor < uses_.size()) ++uses_[*accessor];
    };
    const auto use_all = [&](const Json& attributes) {
      if (!attributes.is_object()) return;
      for (const auto& [key, value] : attributes.items()) use(value);
    };
    for (const Json& mesh : list_of(document_, "meshes")) {
      for (const Json& primitive : list_of(mesh, "primitives")) {
        use_all(member_of(primitive, "attributes"));
        use(member_of(primitive, "indices"));
        for (const Json& target : list_of(primitive, "targets")) use_all(target);
      }
    }
    for (const Json& node : list_of(document_, "nodes"))
      use_all(member_of(member_of(member_of(node, "extensions"), "EXT_mesh_gpu_instancing"), "attributes"));
    for (const Json& animation : list_of(document_, "animations")) {
      for (const Json& sampler : list_of(animation, "samplers")) use_all(sampler);
    }
    for (const Json& skin : list_of(document_, "skins")) use(member_of(skin, "inverseBindMatrices"));
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

  using Vertices = std::array<int, 4>;  // a mesh, and accessors of positions, normals and tangents

  void list_primitives() {
    const auto accessor = [](const tinygltf::Primitive& p, const char* attribute) {
      const auto found = p.attributes.find(attribute);
      return found == p.attributes.end() ? -1 : found->second;
    };
    for (std::size_t mesh = 0; mesh < model_->meshes.size(); ++mesh) {
      const auto& primitives = model_->meshes[mesh].primitives;
      for (std::size_t i = 0; i < primitives.size(); ++i)
        primitives_[{static_cast<int>(mesh), accessor(primitives[i], "POSITION"),
                     accessor(primitives[i], "NORMAL"), accessor(primitives[i], "TANGENT")}]
            .push_back(i);
    }
  }

  // Those of its mesh that have the piece's vertices, as the file names them.
  std::vector<Json*> primitives_of(const GltfPiece& piece) {
    const GltfPlacement& placement = map_.placements[piece.placement];
    const std::size_t mesh = document_["nodes"][static_cast<std::size_t>(placement.node)]["mesh"];
    Json& primitives = document_["meshes"][mesh]["primitives"];
    std::vector<Json*> found;
    for (const std::size_t i : primitives_[{placement.mesh, piece.positions, piece.normals, piece.tangents}])
      found.push_back(&primitives[i]);
    return found;
  }

  struct Bytes {
    std::size_t buffer, begin, end, stride;
    std::size_t accessor;      // that of an image: npos
    std::size_t furthest = 0;  // end of those of the buffer up to this one

    friend bool operator<(const Bytes& a, const Bytes& b) {
      return std::tie(a.buffer, a.begin) < std::tie(b.buffer, b.begin);
    }
  };

  // Which bytes somebody reads, by where they begin.
  void list_bytes() {
    for (std::size_t i = 0; i < model_->accessors.size(); ++i) {
      const auto place = uses_[i] > 0 ? place_if_sound(static_cast<int>(i)) : std::nullopt;
      if (place) bytes_.push_back(bytes_of(*place, i));
    }
    for (const Json& image : list_of(document_, "images")) list_image(image);
    std::sort(bytes_.begin(), bytes_.end());
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
      const bool follows = i > 0 && bytes_[i - 1].buffer == bytes_[i].buffer;
      bytes_[i].furthest = std::max(bytes_[i].end, follows ? bytes_[i - 1].furthest : 0);
    }
  }

  void list_image(const Json& image) {
    const auto view = count_of(image, "bufferView");
    if (!view || *view >= model_->bufferViews.size()) return;
    const tinygltf::BufferView& v = model_->bufferViews[*view];
    bytes_.push_back({static_cast<std::size_t>(v.buffer), v.byteOffset, v.byteOffset + v.byteLength, 0,
                      std::string::npos});
  }

  static Bytes bytes_of(const GltfPlace& p, std::size_t accessor) {
    return {p.buffer, p.offset, p.offset + (p.count - 1) * p.stride + p.size, p.stride, accessor};
  }

  // Neighbours in an interleaved view lie between each other's elements, not over them.
  bool interleaved(const GltfPlace& a, const Bytes& other) const {
    if (a.stride != other.stride) return false;
    const GltfPlace b = accessors_.place(static_cast<int>(other.accessor));
    const std::size_t from = a.offset % a.stride, to = b.offset % b.stride;
    return from + a.size <= to || to + b.size <= from;
  }

  // Floats that no other accessor or image shares a byte with.
  bool is_alone(int accessor, std::size_t components) {
    const auto index = static_cast<std::size_t>(accessor);
    const tinygltf::Accessor& a = model_->accessors[index];
    const GltfPlace place = accessors_.place(accessor);
    if (!place.has_bytes || a.sparse.isSparse || a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        place.size != components * sizeof(float))
      return false;
    const Bytes mine = bytes_of(place, index);
    auto at = std::lower_bound(bytes_.begin(), bytes_.end(), Bytes{mine.buffer, mine.end, 0, 0, 0});
    while (at != bytes_.begin() && (--at)->buffer == mine.buffer && at->furthest > mine.begin) {
      if (++comparisons_ > 100'000'000) return false;  // a file made to take long
      if (at->accessor != index && at->end > mine.begin && !interleaved(place, *at)) return false;
    }
    return true;
  }

  std::optional<GltfPlace> place_if_sound(int accessor) const {
    try {
      const GltfPlace place = accessors_.place(accessor);
      if (place.has_bytes) return place;
    } catch (const base::Error&) {  // what nobody reads need not be sound
    }
    return std::nullopt;
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
  std::vector<std::string> notes_;
  std::vector<std::size_t> uses_;
  std::vector<Bytes> bytes_;
  std::map<Vertices, std::vector<std::size_t>> primitives_;
  std::vector<Vec3> normals_, tangents_, unmoved_normals_, unmoved_tangents_;
  std::size_t comparisons_ = 0;
};

}  // namespace

GltfRewritten rewritten_gltf(const GltfFile& file, const GltfMap& map, const Surface& rest,
                             std::span<const Point> positions) {
  return GltfRewriter(file, map, rest, positions).take();
}

}  // namespace viete::mesh
