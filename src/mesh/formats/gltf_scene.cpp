#include "mesh/formats/gltf_scene.h"

#include <tiny_gltf.h>

#include <cmath>
#include <string>

#include "base/error.h"

namespace viete::mesh {

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

AffineMap map_of_node(const GltfFile& file, int index, const tinygltf::Node& node) {
  const auto has = [&](const Numbers& numbers, std::size_t count) {
    if (numbers.empty()) return false;
    if (numbers.size() != count) refuse_node(file, index, "its place has not as many numbers as it should");
    return true;
  };
  if (has(node.matrix, 16)) return from_matrix(node.matrix);
  AffineMap map = has(node.rotation, 4) ? from_rotation(node.rotation) : AffineMap{};
  if (has(node.scale, 3)) {
    for (std::size_t k = 0; k < 3; ++k) map.columns[k] = node.scale[k] * map.columns[k];
  }
  if (has(node.translation, 3)) map.offset = {node.translation[0], node.translation[1], node.translation[2]};
  return map;
}

class NodeWalk {
public:
  NodeWalk(const GltfFile& file, const tinygltf::Model& model) : file_(file), model_(model) {}

  std::vector<GltfPlacement> walk() {
    seen_.assign(model_.nodes.size(), 0);
    const std::vector<int> roots = this->roots();
    for (std::size_t i = roots.size(); i-- > 0;) open_.push_back({roots[i], {}});
    while (!open_.empty()) visit();
    return std::move(placements_);
  }

private:
  struct Open {
    int node;
    AffineMap parent;
  };

  std::vector<int> roots() const {
    if (!model_.scenes.empty()) {
      const int scene = model_.defaultScene < 0 ? 0 : model_.defaultScene;
      if (static_cast<std::size_t>(scene) >= model_.scenes.size())
        throw base::Error(file_.name, "scene " + std::to_string(scene) + " is not there",
                          "export the model again");
      return model_.scenes[static_cast<std::size_t>(scene)].nodes;
    }
    std::vector<char> is_child(model_.nodes.size(), 0);
    for (const auto& node : model_.nodes) {
      for (const int child : node.children) {
        if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
          is_child[static_cast<std::size_t>(child)] = 1;
      }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) roots.push_back(static_cast<int>(i));
    }
    return roots;
  }

  void visit() {
    const Open open = open_.back();
    open_.pop_back();
    const auto index = static_cast<std::size_t>(open.node);
    if (open.node < 0 || index >= model_.nodes.size())
      refuse_node(file_, open.node, "is not there, the file has " + std::to_string(model_.nodes.size()));
    if (seen_[index]) refuse_node(file_, open.node, "is placed twice: nodes must form trees");
    seen_[index] = 1;
    const tinygltf::Node& node = model_.nodes[index];
    const AffineMap map = open.parent * map_of_node(file_, open.node, node);
    if (node.mesh >= 0) place(open.node, node, map);
    for (std::size_t i = node.children.size(); i-- > 0;) open_.push_back({node.children[i], map});
  }

  void place(int index, const tinygltf::Node& node, const AffineMap& map) {
    if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size())
      refuse_node(file_, index, "refers to mesh " + std::to_string(node.mesh) + ", which is not there");
    // The place of a mesh that hangs on bones is that of the bones: at rest as it was modelled.
    placements_.push_back({index, node.mesh, node.skin >= 0 ? AffineMap{} : map});
  }

  const GltfFile& file_;
  const tinygltf::Model& model_;
  std::vector<char> seen_;
  std::vector<Open> open_;
  std::vector<GltfPlacement> placements_;
};

}  // namespace

Vec3 AffineMap::of_normal(const Vec3& n) const {
  const Vec3 turned = n[0] * cross(columns[1], columns[2]) + n[1] * cross(columns[2], columns[0]) +
                      n[2] * cross(columns[0], columns[1]);
  return determinant() < 0 ? -1 * turned : turned;
}

std::optional<AffineMap> AffineMap::inverse() const {
  const double d = determinant();
  const double size = norm(columns[0]) * norm(columns[1]) * norm(columns[2]);
  if (!(std::abs(d) > 1e-12 * size)) return std::nullopt;
  const Vec3 rows[3] = {(1 / d) * cross(columns[1], columns[2]), (1 / d) * cross(columns[2], columns[0]),
                        (1 / d) * cross(columns[0], columns[1])};
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

std::vector<GltfPlacement> placements_of(const GltfFile& file, const tinygltf::Model& model) {
  return NodeWalk(file, model).walk();
}

}  // namespace viete::mesh
