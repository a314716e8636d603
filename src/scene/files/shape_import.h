// Shapes of a model from files of other programs.
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
  std::vector<std::string> warnings;         ///< one line each; also if the vertex order was recovered
  std::vector<std::filesystem::path> files;  ///< the files read
};

/// Each file gives a shape named after it: a model of any format with the same faces. A numbered name
/// (`pose_##.obj`) stands for the files of its sequence, a folder for its models that fit; a point cache of
/// several frames gives a shape per frame, and a glTF file with morph targets a shape per target.
///
/// Vertices may be reordered, as by formats that do not preserve order: they are matched by the corners of
/// the faces, whose order must be the same. Throws base::Error: the first vertex count, face or position that
/// does not fit; no file; more shapes than a timeline holds. Thread-safe.
ImportedShapes read_shapes(std::span<const std::filesystem::path> files, const mesh::Surface& model,
                           base::Progress* progress = nullptr);

/// Throws base::Error if the shapes exceed a timeline's limit, or the memory with their vectors. place: the
/// file's name.
void check_shape_count(const std::string& place, std::size_t count, const mesh::Surface& model);

}  // namespace viete::scene
