// Shapes of a model, from files of other programs.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/surface.h"
#include "scene/document/document_state.h"

namespace viete::scene {

struct ImportedShapes {
  std::vector<NamedShape> shapes;
  std::vector<std::string> warnings;         ///< one line each: also that an order was recovered
  std::vector<std::filesystem::path> files;  ///< that were read
};

/// Each file gives a shape of its name: a model of any format with the same faces. A name with a place for
/// the number (`pose_##.obj`) stands for the files of the sequence, a folder for those of its models that are
/// shapes; a point cache of several frames gives a shape a frame; a glTF file with morph targets one a
/// target.
///
/// Vertices may stand in another order, as in formats that keep none: where the faces stand in the same order
/// their corners tell it. Throws base::Error: the first vertex count, face or position that does not fit; no
/// file; more shapes than a timeline holds. Thread-safe.
ImportedShapes read_shapes(std::span<const std::filesystem::path> files, const mesh::Surface& model,
                           base::Progress* progress = nullptr);

/// Throws base::Error where so many are more than a timeline, or memory with their vectors, holds. place: the
/// file that holds them.
void check_shape_count(const std::string& place, std::size_t count, const mesh::Surface& model);

}  // namespace viete::scene
