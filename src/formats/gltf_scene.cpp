#include "formats/gltf_scene.h"

#include <cmath>
#include <string>

#include "base/error.h"

namespace viete::formats {

namespace {

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
