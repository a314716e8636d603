// Morph targets of a glTF file and the animation of their weights: reading and adding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "formats/gltf_accessors.h"
#include "formats/gltf_file.h"
#include "formats/gltf_scene.h"
#include "formats/morphs.h"

namespace viete::formats {

/// The default weights of `count` targets: the node's, otherwise the mesh's.
std::vector<double> default_weights(const GltfJson& document, const GltfPlacement& placement,
                                    std::size_t count);

/// Weighted sum of a piece's target offsets (positions, normals or tangents): three numbers a vertex; empty
/// if all weights are 0. Throws base::Error.
std::vector<double> morph_differences(const GltfAccessors& accessors, const GltfPiece& piece,
                                      int GltfTarget::*of, std::span<const double> weights);

/// Null if no primitive has targets. Uses the first animation of weights; node animations are ignored. Of
/// merged vertices (seams) the first one counts. Holds one moment in memory at a time. Throws base::Error.
std::shared_ptr<const MorphClip> gltf_morphs(std::shared_ptr<const GltfFile> file,
                                             std::shared_ptr<const GltfMap> map);

/// Appends bytes to a buffer, aligned to four, and adds a buffer view. Returns the view's index.
std::size_t add_gltf_view(GltfJson& document, std::string& bytes, const void* data, std::size_t size,
                          std::size_t buffer = 0);

/// Sets the minimum and maximum of each component.
void set_gltf_bounds(GltfJson& accessor, std::span<const float> values, std::size_t components);

/// Vertices shared by primitives of one mesh, as written: three numbers each.
struct MorphedVertices {
  std::size_t node = 0;  ///< the only node that places the mesh
  std::vector<std::size_t> primitives;
  std::vector<float> positions, normals, tangents;  ///< the last two may be empty
};

/// Borrows both arguments.
class GltfMorphs {
public:
  /// bytes: the document's first buffer.
  GltfMorphs(GltfJson& document, std::string& bytes) : document_(document), bytes_(bytes) {}

  /// Adds a target to all primitives, three numbers per vertex. Empty normals or tangents are not animated.
  void add_target(const MorphedVertices& vertices, std::span<const double> positions,
                  std::span<const double> normals, std::span<const double> tangents);

  /// Appends the motion's targets to those of the nodes' meshes, and adds its animation. add_target(now) must
  /// call the function above for all vertices. floats: number of floats that one target adds. Existing weight
  /// animations of these nodes, read by numbers_of(accessor), are padded with zeros for the new targets.
  /// progress may be null.
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

}  // namespace viete::formats
