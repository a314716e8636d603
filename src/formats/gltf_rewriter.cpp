#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "formats/gltf_morphs.h"
#include "formats/gltf_original.h"
#include "mesh/normals.h"

namespace viete::formats {

namespace {

using Json = GltfJson;

class GltfRewriter {
public:
  GltfRewriter(const GltfFile& file, const GltfMap& map, const mesh::Surface& rest,
               std::span<const mesh::Point> positions, const MorphMotion* motion, base::Progress* progress)
      : file_(file), map_(map), rest_(rest), posed_(positions), accessors_(file), document_(file.document) {
    for (const GltfBuffer& buffer : file.buffers) buffers_.push_back(buffer.bytes);
    if (motion) find_morphing(*motion);
    for (const GltfPiece& piece : map.pieces)
      if (moves(piece) || morphs(piece)) moved_.push_back(&piece);
    if (!moved_.empty()) rewrite();
    if (motion) put_morphs(*motion, progress);
  }

  GltfRewritten take() && {
    std::ranges::move(rounding_notes(rounding_, mesh::bounds(posed_).diagonal()), std::back_inserter(notes_));
    return {std::move(document_), std::move(buffers_), std::move(notes_)};
  }

private:
  bool moves(std::size_t vertex) const {
    const std::uint32_t v = map_.surface_vertex[vertex];
    return rest_.positions[v] != posed_[v];
  }

  bool moves(const GltfPiece& piece) const {
    for (std::size_t i = 0; i < piece.count; ++i)
      if (moves(piece.first + i)) return true;
    return false;
  }

  void find_morphing(const MorphMotion& motion) {
    morphing_.assign(map_.placements.size(), false);
    for (const GltfPiece& piece : map_.pieces)
      for (std::size_t i = 0; i < piece.count && !morphing_[piece.placement]; ++i)
        morphing_[piece.placement] = motion.moves[map_.surface_vertex[piece.first + i]] != 0;
  }

  bool morphs(const GltfPiece& piece) const { return !morphing_.empty() && morphing_[piece.placement]; }

  void rewrite() {
    part_instances();
    sharing_.emplace(document_, accessors_);
    list_primitives();
    deform_directions();
    deform_targets();
    for (const GltfPiece* piece : moved_) {
      const AffineMap inverse = inverse_of(*piece);
      if (!moves(*piece)) continue;
      const auto put_attribute = [&](const char* attribute, int accessor, std::size_t components,
                                     const std::vector<float>& values) {
        put(*piece, accessor, components, values, *attribute == 'P',
            [&](Json& primitive) { return &primitive["attributes"][attribute]; });
      };
      put_attribute("POSITION", piece->positions, 3, positions_of(*piece, inverse));
      if (piece->normals >= 0) put_attribute("NORMAL", piece->normals, 3, normals_of(*piece, inverse));
      if (piece->tangents >= 0) put_attribute("TANGENT", piece->tangents, 4, tangents_of(*piece, inverse));
    }
  }

  // The offsets of the file's targets follow the surface.
  void deform_targets() {
    std::size_t count = 0;
    for (const GltfPiece* piece : moved_)
      if (moves(*piece)) count = std::max(count, piece->targets->size());
    for (std::size_t t = 0; t < count; ++t) {
      deform_target(t, "POSITION", &GltfTarget::positions);
      deform_target(t, "NORMAL", &GltfTarget::normals);
      deform_target(t, "TANGENT", &GltfTarget::tangents);
    }
  }

  void deform_target(std::size_t t, const char* attribute, int GltfTarget::*of) {
    const bool are_positions = of == &GltfTarget::positions;
    const auto accessor_of_target = [&](const GltfPiece& piece) {
      return moves(piece) && t < piece.targets->size() ? (*piece.targets)[t].*of : -1;
    };
    std::vector<double> alone(t + 1, 0);
    alone[t] = 1;
    std::vector<mesh::Vec3> offsets(map_.surface_vertex.size(), mesh::Vec3{0, 0, 0});
    bool is_used = false;
    for (const GltfPiece* piece : moved_) {
      if (accessor_of_target(*piece) < 0) continue;
      is_used = true;
      const std::vector<double> own = morph_differences(accessors_, *piece, of, alone);
      const AffineMap& map = map_.placements[piece->placement].map;
      for (std::size_t i = 0; i < piece->count; ++i) {
        const mesh::Vec3 offset = vector_at(own, i);
        offsets[piece->first + i] = are_positions ? map.of_vector(offset) : map.of_normal(offset);
      }
    }
    if (!is_used) return;
    const auto kind = are_positions ? mesh::OffsetKind::positions : mesh::OffsetKind::directions;
    const std::vector<mesh::Vec3> now =
        deformed_offsets(rest_, posed_, offsets, kind, map_.corner_vertex, map_.surface_vertex);
    for (const GltfPiece* piece : moved_) {
      const int accessor = accessor_of_target(*piece);
      if (accessor < 0) continue;
      const AffineMap inverse = inverse_of(*piece);
      std::vector<float> values = floats(accessor, 3);
      for (std::size_t i = 0; i < piece->count; ++i) {
        const std::size_t v = piece->first + i;
        if (moves(v) && mesh::changed(offsets[v], now[v]))
          set(values, 3 * i, are_positions ? inverse.of_vector(now[v]) : inverse.of_normal(now[v]));
      }
      add_differences(*piece, of, t, values);
      put(*piece, accessor, 3, values, are_positions, [&](Json& primitive) -> Json* {
        if (list_of(primitive, "targets").size() <= t) return nullptr;
        Json& target = primitive["targets"][t];
        return index_of(target, attribute) == accessor ? &target[attribute] : nullptr;
      });
    }
  }

  AffineMap inverse_of(const GltfPiece& piece) const {
    const GltfPlacement& placement = map_.placements[piece.placement];
    const auto inverse = placement.map.inverse();
    if (!inverse)
      throw base::Error(file_.name + ": node " + std::to_string(placement.node),
                        "scales its mesh to zero thickness, so moved positions cannot be stored in it",
                        "apply the node's scale in a modelling program first, or save in another format");
    return *inverse;
  }

  // If several nodes use a mesh, gives each moved node a copy. The last node that uses the original keeps it.
  void part_instances() {
    std::map<int, std::size_t> users;
    for (const Json& node : list_of(document_, "nodes")) ++users[index_of(node, "mesh")];
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
      notes_.push_back("shared meshes were copied " + base::counted(parted, "time") +
                       ", because their nodes deform differently");
  }

  void deform_directions() {
    std::vector<mesh::Vec3> normals(map_.surface_vertex.size(), mesh::Vec3{0, 0, 0}), tangents = normals;
    bool has_normals = false, has_tangents = false;
    for (const GltfPiece* piece : moved_) {
      const AffineMap& map = map_.placements[piece->placement].map;
      const auto take = [&](int accessor, int GltfTarget::*of, std::vector<mesh::Vec3>& to, auto move) {
        if (accessor < 0) return false;
        const std::vector<double> numbers = accessors_.numbers(accessor, 3);
        const std::vector<double> added = old_differences(*piece, of);
        for (std::size_t i = 0; i < piece->count; ++i)
          to[piece->first + i] = move(vector_at(numbers, i) + vector_at(added, i));
        return true;
      };
      has_normals |= take(piece->normals, &GltfTarget::normals, normals,
                          [&](const mesh::Vec3& n) { return map.of_normal(n); });
      has_tangents |= take(piece->tangents, &GltfTarget::tangents, tangents,
                           [&](const mesh::Vec3& t) { return map.of_vector(t); });
    }
    if (has_normals)
      normals_ = deformed_normals(rest_, posed_, normals, map_.corner_vertex, map_.surface_vertex);
    if (has_tangents)
      tangents_ = deformed_tangents(rest_, posed_, tangents, map_.corner_vertex, map_.surface_vertex);
    unmoved_normals_ = std::move(normals);
    unmoved_tangents_ = std::move(tangents);
  }

  std::vector<double> weights_of(const GltfPiece& piece) const {
    return default_weights(file_.document, map_.placements[piece.placement], piece.targets->size());
  }

  // Viewers add the offsets of the file's targets, at their default weights. Returns the sum of the offsets
  // in the file that was read.
  std::vector<double> old_differences(const GltfPiece& piece, int GltfTarget::*of) const {
    return morph_differences(accessors_, piece, of, weights_of(piece));
  }

  // Returns the sum of the offsets in the new file.
  std::vector<double> differences(const GltfPiece& piece, int GltfTarget::*of) const {
    if (!moves(piece)) return old_differences(piece, of);
    const auto found = differences_.find({&piece, kind_of(of)});
    return found == differences_.end() ? std::vector<double>() : found->second;
  }

  void add_differences(const GltfPiece& piece, int GltfTarget::*of, std::size_t target,
                       std::span<const float> offsets) {
    const double weight = weights_of(piece)[target];
    if (weight == 0) return;
    std::vector<double>& sum = differences_[{&piece, kind_of(of)}];
    sum.resize(offsets.size(), 0);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * static_cast<double>(offsets[i]);
  }

  static int kind_of(int GltfTarget::*of) {
    return of == &GltfTarget::positions ? 0 : of == &GltfTarget::normals ? 1 : 2;
  }

  static mesh::Vec3 vector_at(std::span<const double> numbers, std::size_t i) {
    return numbers.empty() ? mesh::Vec3{0, 0, 0}
                           : mesh::Vec3{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  }

  // Returns a unit vector x such that x + added has the direction `unit`, if this is possible.
  static mesh::Vec3 before_targets(const mesh::Vec3& unit, const mesh::Vec3& added) {
    const double along = mesh::dot(unit, added), rest = along * along - mesh::dot(added, added) + 1;
    const double length = rest < 0 ? 1 : along + std::sqrt(rest);
    return length > 0 ? unit_or_zero(length * unit - added) : unit;
  }

  std::vector<float> positions_of(const GltfPiece& piece, const AffineMap& inverse) {
    std::vector<float> values = floats(piece.positions, 3);
    const std::vector<double> added = differences(piece, &GltfTarget::positions);
    for (std::size_t i = 0; i < piece.count; ++i) {
      if (!moves(piece.first + i)) continue;
      const std::uint32_t v = map_.surface_vertex[piece.first + i];
      const mesh::Point local = inverse.of_point(posed_[v]) - vector_at(added, i);
      check_written(file_.name, v, local, largest_float);
      set(values, 3 * i, local);
      add_rounding(piece, local);
    }
    return values;
  }

  void add_rounding(const GltfPiece& piece, const mesh::Point& local) {
    mesh::Vec3 change = local;
    for (double& x : change) x = static_cast<double>(static_cast<float>(x)) - x;
    const AffineMap& map = map_.placements[piece.placement].map;
    rounding_ = std::max(rounding_, mesh::largest_abs(map.of_vector(change)));
  }

  std::vector<float> normals_of(const GltfPiece& piece, const AffineMap& inverse) const {
    std::vector<float> values = floats(piece.normals, 3);
    const std::vector<double> added = differences(piece, &GltfTarget::normals);
    for (std::size_t i = 0; i < piece.count; ++i) {
      const mesh::Vec3& n = normals_[piece.first + i];
      if (mesh::changed(unmoved_normals_[piece.first + i], n))
        set(values, 3 * i, before_targets(unit_or_zero(inverse.of_normal(n)), vector_at(added, i)));
    }
    return values;
  }

  // Returns the tangent in node coordinates. If the normal is not 0, the tangent is orthogonal to the normal.
  static mesh::Vec3 local_tangent(const AffineMap& inverse, const mesh::Vec3& tangent,
                                  const mesh::Vec3& normal) {
    const mesh::Vec3 n = unit_or_zero(inverse.of_normal(normal)), t = inverse.of_vector(tangent);
    return unit_or_zero(t - mesh::dot(t, n) * n);
  }

  std::vector<float> tangents_of(const GltfPiece& piece, const AffineMap& inverse) const {
    std::vector<float> values = floats(piece.tangents, 4);
    const std::vector<double> added = differences(piece, &GltfTarget::tangents);
    for (std::size_t i = 0; i < piece.count; ++i) {
      const std::size_t v = piece.first + i;
      if (mesh::changed(unmoved_tangents_[v], tangents_[v]))
        set(values, 4 * i,
            before_targets(local_tangent(inverse, tangents_[v], normal_of(piece, normals_, v)),
                           vector_at(added, i)));
    }
    return values;
  }

  static mesh::Vec3 normal_of(const GltfPiece& piece, const std::vector<mesh::Vec3>& normals,
                              std::size_t vertex) {
    return piece.normals < 0 ? mesh::Vec3{0, 0, 0} : normals[vertex];
  }

  struct MorphedPiece {
    const GltfPiece* piece;
    AffineMap inverse;
    MorphedVertices vertices;
  };

  // If several pieces differ only in texture points, returns only one, because their primitives are the same.
  std::vector<MorphedPiece> morphed_pieces(bool with_normals) {
    std::vector<MorphedPiece> found;
    std::set<std::array<int, 4>> seen;
    for (const GltfPiece* piece : moved_) {
      const bool is_new =
          seen.insert({static_cast<int>(piece->placement), piece->positions, piece->normals, piece->tangents})
              .second;
      if (!morphs(*piece) || !is_new) continue;
      const GltfPlacement& placement = map_.placements[piece->placement];
      MorphedPiece made{piece, inverse_of(*piece), {}};
      made.vertices.node = static_cast<std::size_t>(placement.node);
      made.vertices.primitives = primitive_numbers(*piece);
      made.vertices.positions = positions_of(*piece, made.inverse);
      if (with_normals && piece->normals >= 0) made.vertices.normals = normals_of(*piece, made.inverse);
      if (with_normals && piece->tangents >= 0) {
        const std::vector<float> four = tangents_of(*piece, made.inverse);
        for (std::size_t i = 0; i < four.size(); i += 4)
          made.vertices.tangents.insert(made.vertices.tangents.end(), {four[i], four[i + 1], four[i + 2]});
      }
      found.push_back(std::move(made));
    }
    return found;
  }

  void put_morphs(const MorphMotion& motion, base::Progress* progress) {
    const std::vector<MorphedPiece> pieces = morphed_pieces(motion.normals);
    if (pieces.empty()) return void(notes_.push_back("no animation was written: no key moves the model"));
    const std::size_t own = list_of(document_, "animations").size();
    GltfMorphs out(document_, buffers_.front());
    std::vector<std::size_t> nodes;
    std::size_t floats = 0;
    for (const auto& [piece, inverse, vertices] : pieces) {
      if (nodes.empty() || nodes.back() != vertices.node) nodes.push_back(vertices.node);
      floats += vertices.positions.size() + vertices.normals.size() + vertices.tangents.size();
    }
    out.add(
        motion, nodes, floats, progress,
        [&](const std::vector<mesh::Point>& now) { add_target(out, pieces, now, motion.normals); },
        [&](int output) { return accessors_.numbers(output, 1); });
    if (own > 0)
      notes_.push_back(base::counted(own, "animation") + " of the file " + (own == 1 ? "stays" : "stay") +
                       " in addition to the new one");
  }

  // Unmoved vertices get exactly the values of the file, so that the offsets are exactly 0.
  void add_target(GltfMorphs& out, const std::vector<MorphedPiece>& pieces, std::span<const mesh::Point> now,
                  bool with_normals) {
    std::vector<mesh::Vec3> normals, tangents;
    if (with_normals && !normals_.empty())
      normals = deformed_normals(rest_, now, unmoved_normals_, map_.corner_vertex, map_.surface_vertex);
    if (with_normals && !tangents_.empty())
      tangents = deformed_tangents(rest_, now, unmoved_tangents_, map_.corner_vertex, map_.surface_vertex);
    for (const MorphedPiece& p : pieces) {
      const auto values = [&](const std::vector<float>& base, int GltfTarget::*of, const auto& moved,
                              const auto& local) {
        std::vector<double> all(base.begin(), base.end());
        const std::vector<double> added = differences(*p.piece, of);
        for (std::size_t i = 0; 3 * i < all.size(); ++i) {
          const std::size_t v = p.piece->first + i;
          if (!moved(v)) continue;
          const mesh::Vec3 to = local(v) - vector_at(added, i);
          std::copy(to.begin(), to.end(), all.begin() + static_cast<std::ptrdiff_t>(3 * i));
        }
        return all;
      };
      const auto place = [&](std::size_t v) { return map_.surface_vertex[v]; };
      out.add_target(
          p.vertices,
          values(
              p.vertices.positions, &GltfTarget::positions,
              [&](auto v) { return now[place(v)] != posed_[place(v)]; },
              [&](auto v) {
                const mesh::Point local = p.inverse.of_point(now[place(v)]);
                add_rounding(*p.piece, local);  // other programs add offsets to positions in float
                return local;
              }),
          values(
              p.vertices.normals, &GltfTarget::normals, [&](auto v) { return normals[v] != normals_[v]; },
              [&](auto v) { return unit_or_zero(p.inverse.of_normal(normals[v])); }),
          values(
              p.vertices.tangents, &GltfTarget::tangents, [&](auto v) { return tangents[v] != tangents_[v]; },
              [&](auto v) {
                return local_tangent(p.inverse, tangents[v], normal_of(*p.piece, normals, v));
              }));
    }
  }

  static mesh::Vec3 unit_or_zero(const mesh::Vec3& v) {
    const double length = mesh::stable_norm(v);
    return length > 0 ? (1 / length) * v : mesh::Vec3{0, 0, 0};
  }

  static void set(std::vector<float>& values, std::size_t at, const mesh::Vec3& v) {
    for (std::size_t k = 0; k < 3; ++k) values[at + k] = static_cast<float>(v[k]);
  }

  std::vector<float> floats(int accessor, std::size_t components) const {
    const std::vector<double> numbers = accessors_.numbers(accessor, components);
    return {numbers.begin(), numbers.end()};
  }

  // Replaces the values in place if no other part of the file uses the accessor. Otherwise adds an accessor.
  // slot(primitive) must return the number of the accessor in this primitive, or null.
  template <class Slot>
  void put(const GltfPiece& piece, int accessor, std::size_t components, const std::vector<float>& values,
           bool are_positions, const Slot& slot) {
    const std::vector<Json*> primitives = primitives_of(piece);
    const auto index = static_cast<std::size_t>(accessor);
    const bool in_place =
        sharing_->uses(index) == primitives.size() && sharing_->is_alone(accessor, components);
    const std::size_t to = in_place ? index : appended(index, components, values);
    if (in_place) {
      const GltfPlace place = accessors_.place(accessor);
      for (std::size_t i = 0; i < place.count; ++i)
        std::memcpy(buffers_[place.buffer].data() + place.offset + i * place.stride, &values[i * components],
                    components * sizeof(float));
    }
    for (Json* primitive : primitives)
      if (Json* const number = slot(*primitive)) *number = to;
    Json& json = document_["accessors"][to];  // in glTF, only positions must have min and max
    if (are_positions || json.contains("min") || json.contains("max"))
      set_gltf_bounds(json, values, components);
  }

  using Vertices = std::array<int, 4>;  // mesh, then accessors: positions, normals, tangents

  void list_primitives() {
    const Json& meshes = list_of(file_.document, "meshes");
    for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
      const Json& primitives = list_of(meshes[mesh], "primitives");
      for (std::size_t i = 0; i < primitives.size(); ++i)
        primitives_[{static_cast<int>(mesh), accessor_of(primitives[i], "POSITION"),
                     accessor_of(primitives[i], "NORMAL"), accessor_of(primitives[i], "TANGENT")}]
            .push_back(i);
    }
  }

  // Returns the indices of the primitives that use the piece's vertices.
  const std::vector<std::size_t>& primitive_numbers(const GltfPiece& piece) {
    return primitives_[{map_.placements[piece.placement].mesh, piece.positions, piece.normals,
                        piece.tangents}];
  }

  std::vector<Json*> primitives_of(const GltfPiece& piece) {
    const GltfPlacement& placement = map_.placements[piece.placement];
    const std::size_t mesh = document_["nodes"][static_cast<std::size_t>(placement.node)]["mesh"];
    Json& primitives = document_["meshes"][mesh]["primitives"];
    std::vector<Json*> found;
    for (const std::size_t i : primitive_numbers(piece)) found.push_back(&primitives[i]);
    return found;
  }

  // Adds an accessor like `old` with new data at the end of the buffer of `old`. Returns the new index.
  std::size_t appended(std::size_t old, std::size_t components, const std::vector<float>& values) {
    const GltfPlace place = accessors_.place(static_cast<int>(old));
    const std::size_t view = add_gltf_view(document_, buffers_[place.buffer], values.data(),
                                           values.size() * sizeof(float), place.buffer);
    document_["bufferViews"][view]["target"] = gltf_array_buffer;
    Json accessor = document_["accessors"][old];
    for (const char* key : {"sparse", "byteOffset", "normalized"}) accessor.erase(key);
    accessor["bufferView"] = view;
    accessor["componentType"] = gltf_float;
    accessor["type"] = components == 4 ? "VEC4" : "VEC3";
    document_["accessors"].push_back(std::move(accessor));
    return document_["accessors"].size() - 1;
  }

  const GltfFile& file_;
  const GltfMap& map_;
  const mesh::Surface& rest_;
  std::span<const mesh::Point> posed_;
  GltfAccessors accessors_;
  Json document_;
  std::vector<std::string> buffers_;
  std::vector<const GltfPiece*> moved_;
  std::vector<std::string> notes_;
  double rounding_ = 0;  // the largest rounding of a coordinate, in scene units
  std::optional<GltfSharing> sharing_;
  std::map<Vertices, std::vector<std::size_t>> primitives_;
  std::vector<mesh::Vec3> normals_, tangents_, unmoved_normals_, unmoved_tangents_;
  std::map<std::pair<const GltfPiece*, int>, std::vector<double>> differences_;  // of the file's new targets
  std::vector<bool> morphing_;  // true if a target moves this placement; empty without an animation
};

}  // namespace

GltfRewritten rewritten_gltf(const GltfFile& file, const GltfMap& map, const mesh::Surface& rest,
                             std::span<const mesh::Point> positions, const MorphMotion* motion,
                             base::Progress* progress) {
  return GltfRewriter(file, map, rest, positions, motion, progress).take();
}

}  // namespace viete::formats
