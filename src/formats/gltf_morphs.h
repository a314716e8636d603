// Reads the morph targets and their animated weights from a glTF file. Adds new targets to a file.
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
#include "formats/original.h"

namespace viete::formats {

/// Returns the default weights of `count` targets. Weights of the node replace weights of the mesh.
std::vector<double> default_weights(const GltfJson& document, const GltfPlacement& placement,
                                    std::size_t count);

/// Returns the sum of weight * offset over all targets, with three numbers per vertex. `of` selects
/// positions, normals or tangents. If all weights are 0, the result is empty. Can throw base::Error.
std::vector<double> morph_differences(const GltfAccessors& accessors, const GltfPiece& piece,
                                      int GltfTarget::*of, std::span<const double> weights);

/// Returns the morph animation, or null if no primitive has targets. Uses the first animation of weights and
/// ignores animations of nodes. Merged vertices get the position of the first of
/// them. Throws base::Error if the data is invalid.
std::shared_ptr<const MorphClip> gltf_morphs(std::shared_ptr<const GltfFile> file,
                                             std::shared_ptr<const GltfMap> map);

/// Pads `bytes` to a multiple of four, appends the data and adds a buffer view. Returns the view's index.
std::size_t add_gltf_view(GltfJson& document, std::string& bytes, const void* data, std::size_t size,
                          std::size_t buffer = 0);

/// Sets the members "min" and "max" of the accessor, with one number per component.
void set_gltf_bounds(GltfJson& accessor, std::span<const float> values, std::size_t components);

/// Vertices that one or more primitives of a mesh use. The values are at rest, three numbers per vertex.
struct MorphedVertices {
  std::size_t node = 0;  ///< the only node that places the mesh
  std::vector<std::size_t> primitives;
  std::vector<float> positions, normals, tangents;  ///< normals and tangents may be empty
};

class GltfMorphs {
public:
  /// Keeps references to the arguments. `bytes` is the first buffer of the document.
  GltfMorphs(GltfJson& document, std::string& bytes) : document_(document), bytes_(bytes) {}

  /// Adds a target to the primitives. The spans have the values at full weight, three numbers per vertex. If
  /// `normals` or `tangents` is empty, does not animate it.
  void add_target(const MorphedVertices& vertices, std::span<const double> positions,
                  std::span<const double> normals, std::span<const double> tangents);

  /// Appends the motion's targets and its animation to the meshes of these nodes. In existing animations, the
  /// new targets have the weight 0. `progress` may be null. The other arguments are:
  /// - floats: the number of floats that one target adds
  /// - add_target(positions): must call GltfMorphs::add_target() for the moved vertices of these meshes
  /// - numbers_of(accessor): must return the numbers of an accessor
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
