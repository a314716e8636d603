// Morph targets of a glTF file and the animation of their weights: read, and added to a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/formats/gltf_accessors.h"
#include "mesh/formats/gltf_file.h"
#include "mesh/formats/gltf_scene.h"
#include "mesh/formats/morphs.h"

namespace viete::mesh {

/// The weights of so many targets where nothing plays: the node's, or those of its mesh where it has none.
std::vector<double> default_weights(const GltfJson& document, const GltfPlacement& placement,
                                    std::size_t count);

/// Weighted sum of the offsets of positions, normals or tangents of a piece by its targets: three
/// numbers a vertex; empty where no weight but 0 counts. Throws base::Error.
std::vector<double> morph_differences(const GltfAccessors& accessors, const GltfPiece& piece,
                                      int GltfTarget::*of, std::span<const double> weights);

/// Null where no primitive has targets. Of several animations the first one that plays weights; what moves
/// nodes is not played. Of vertices that are one of the surface (seams) the first one counts. Memory is taken
/// for one moment at a time, whatever the file says. Throws base::Error.
std::shared_ptr<const MorphClip> gltf_morphs(std::shared_ptr<const GltfFile> file,
                                             std::shared_ptr<const GltfMap> map);

/// Appends bytes at a multiple of four to those of a buffer; the number of the view that is added for them.
std::size_t add_gltf_view(GltfJson& document, std::string& bytes, const void* data, std::size_t size,
                          std::size_t buffer = 0);

/// Lowest and highest of each of the components.
void set_gltf_bounds(GltfJson& accessor, std::span<const float> values, std::size_t components);

/// Vertices that primitives of one mesh share, as they are written: three numbers each.
struct MorphedVertices {
  std::size_t node = 0;  ///< that places the mesh, alone
  std::vector<std::size_t> primitives;
  std::vector<float> positions, normals, tangents;  ///< the last two may be empty
};

/// Borrows both until the animation is there.
class GltfMorphs {
public:
  /// bytes: of the document's first buffer.
  GltfMorphs(GltfJson& document, std::string& bytes) : document_(document), bytes_(bytes) {}

  /// One more target for all its primitives, three numbers for each of what the vertices have; no normals or
  /// tangents: these do not follow.
  void add_target(const MorphedVertices& vertices, std::span<const double> positions,
                  std::span<const double> normals, std::span<const double> tangents);

  /// The targets of the motion behind those that the nodes' meshes have, and its animation. add_target(now)
  /// calls the one above for all vertices, which are so many floats. Tells progress, which may be null. Of
  /// the file's own animations of these nodes' weights `numbers_of(accessor)` gives the numbers: they get
  /// zeros for the new targets.
  template <class AddTarget, class NumbersOf>
  void add(const MorphMotion& motion, std::span<const std::size_t> nodes, std::size_t floats,
           base::Progress* progress, const AddTarget& add_target, const NumbersOf& numbers_of) {
    std::vector<std::size_t> before;
    for (const std::size_t node : nodes) before.push_back(targets_of(node));
    const std::size_t count = motion.targets.size();
    bytes_.reserve(bytes_.size() + count * floats * sizeof(float));
    for (std::size_t t = 0; t < count; ++t) {
      if (progress) progress->report(0.9 * static_cast<double>(t) / static_cast<double>(count));
      add_target(motion.positions(t));
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (const Output& output : weights_of(nodes[i])) {
        const std::vector<double> numbers = numbers_of(output.accessor);
        widen(output, numbers, before[i], count);
      }
      name_targets(motion, nodes[i], before[i]);
    }
    animate(motion, nodes, before);
  }

private:
  struct Output {
    std::size_t animation, channel;
    int accessor;
  };

  GltfJson& mesh_of(std::size_t node) const;
  std::size_t targets_of(std::size_t node) const;
  std::vector<Output> weights_of(std::size_t node) const;
  void widen(const Output& output, std::span<const double> numbers, std::size_t before, std::size_t added);
  void name_targets(const MorphMotion& motion, std::size_t node, std::size_t before);
  void animate(const MorphMotion& motion, std::span<const std::size_t> nodes,
               std::span<const std::size_t> before);

  std::size_t add_floats(std::span<const float> values, std::size_t parts);
  GltfJson sparse(std::span<const std::uint32_t> where, std::span<const float> some, std::size_t index_size);
  std::size_t add_deltas(std::span<const float> base, std::span<const double> now);

  GltfJson& document_;
  std::string& bytes_;
};

}  // namespace viete::mesh
