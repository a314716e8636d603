// Imports shapes of a model from meshes, folders, sequences, point caches and morph targets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/numbered_files.h"
#include "base/progress.h"
#include "document/document_state.h"
#include "formats/original.h"
#include "mesh/surface.h"

namespace viete::files {

struct ImportedShapes {
  std::vector<document::NamedShape> shapes;
  std::vector<std::string> warnings;         ///< one line each
  std::vector<std::filesystem::path> files;  ///< the files that were read
};

/// Reads models with the faces of `model`. Each file gives a shape with the file's name. A numbered name
/// (`pose_##.obj`) gives all files of the sequence. A folder gives all its models that match. A point cache
/// gives a shape for each frame. A glTF file with morph targets gives a shape for each target.
///
/// Some formats do not keep the vertex order. If the vertex order differs, adds a warning and matches the
/// vertices by the corners of the faces, see mesh::vertex_order(). Throws base::Error if a file does not
/// match the model, a sequence or folder gives no shape, or there are too many shapes. Thread-safe.
ImportedShapes read_shapes(std::span<const std::filesystem::path> files, const mesh::Surface& model,
                           base::Progress* progress = nullptr);

/// Throws base::Error if no triangle of the model has an area: such models have no log space. place: a file
/// name.
void check_shape_rest(const std::string& place, const mesh::Surface& model);
/// If the shapes exceed the limit of a timeline or the free memory, throws base::Error. place: a file name.
void check_shape_count(const std::string& place, std::size_t count, const mesh::Surface& model);

/// The surface to which imported positions belong.
struct PosedSurface {
  const mesh::Surface& surface;
  const char* what;  ///< name for messages: "the cage" or "the model"
};

/// Sorts by file name in natural order: a2.obj before a10.obj.
void sort_by_numbers(std::vector<std::filesystem::path>& files);

/// Calls read(file) for all models in a folder, in natural order. read() must return true if the file was
/// used. If read() throws base::Error, adds a warning and continues. If no file was used, throws base::Error
/// with `wanted` and `advice`. progress may be null.
void read_folder(const std::filesystem::path& folder, const char* wanted, const char* advice,
                 const std::function<bool(const std::filesystem::path&)>& read,
                 std::vector<std::string>& warnings, base::Progress* progress);
/// Returns the files of a numbered name. If there are no files, throws base::Error.
std::vector<base::NumberedFile> files_of(const base::NumberedName& name);

/// Throws base::Error if a coordinate exceeds 1e32, the limit of opened surfaces. place: the file's name.
void check_places(const std::string& place, std::span<const mesh::Point> positions);
/// Throws base::Error if the number of points differs from the number of vertices.
void check_points(const std::string& place, std::size_t found, const PosedSurface& of);

/// Positions of a surface from the morph targets of a file.
struct MorphPositions {
  std::shared_ptr<const formats::MorphClip> clip;  ///< null if the file has no morph targets
  std::vector<std::uint32_t> order;                ///< for each vertex of the surface, its index in the file

  std::vector<mesh::Point> at(double second) const {
    return mesh::picked<mesh::Point>(clip->at(second), order);
  }
  std::vector<mesh::Point> at_target(std::size_t target) const {
    return mesh::picked<mesh::Point>(clip->at_target(target), order);
  }
};

/// If the faces of file and surface differ, matches vertices by their rest positions. If the numbers of
/// vertices or the rest positions differ, throws base::Error.
MorphPositions morphs_of(const std::filesystem::path& file, const PosedSurface& of,
                         std::vector<std::string>& warnings);

}  // namespace viete::files
