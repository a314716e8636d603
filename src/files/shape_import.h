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
#include "formats/morphs.h"
#include "mesh/surface.h"

namespace viete::files {

struct ImportedShapes {
  std::vector<document::NamedShape> shapes;
  std::vector<std::string> warnings;         ///< one line each
  std::vector<std::filesystem::path> files;  ///< the files read
};

/// Reads models with the faces of `model`. Each file gives a shape with the name of the file. A numbered name
/// (`pose_##.obj`) stands for all files of the sequence, a folder for all its models that fit. A point cache
/// gives a shape per frame, and a glTF file with morph targets a shape per target.
///
/// Some formats do not keep the vertex order. If it differs, vertices are matched by the corners of the
/// faces, which must be in the same order, and a warning is added. Throws base::Error if the number of
/// vertices, a face or a position does not fit, and if there are no files or too many shapes. Thread-safe.
ImportedShapes read_shapes(std::span<const std::filesystem::path> files, const mesh::Surface& model,
                           base::Progress* progress = nullptr);

/// Throws base::Error if the shapes exceed the limit of a timeline or the free memory. place: a file name.
void check_shape_count(const std::string& place, std::size_t count, const mesh::Surface& model);

/// The surface to which imported positions belong.
struct PosedSurface {
  const mesh::Surface& surface;
  const char* what;  ///< name in messages: "the cage" or "the model"
};

/// Sorts by file name in natural order: a2.obj before a10.obj.
void sort_by_numbers(std::vector<std::filesystem::path>& files);

/// Calls read(file) for all models in a folder in natural order. It must return true if it used the file. If
/// it throws base::Error, the file is skipped with a warning. Throws base::Error if no file was used;
/// `wanted` and `advice` are part of the message. progress may be null.
void read_folder(const std::filesystem::path& folder, const char* wanted, const char* advice,
                 const std::function<bool(const std::filesystem::path&)>& read,
                 std::vector<std::string>& warnings, base::Progress* progress);
/// The files of a numbered name. Throws base::Error if there are none.
std::vector<base::NumberedFile> files_of(const base::NumberedName& name);

/// Throws base::Error if a coordinate is beyond 1e32, the limit of opened surfaces. place: the file's name.
void check_places(const std::string& place, std::span<const mesh::Point> positions);
/// Throws base::Error if the number of points differs from the number of vertices.
void check_points(const std::string& place, std::size_t found, const PosedSurface& of);

/// Positions of a surface from the morph targets of a file.
struct MorphPositions {
  std::shared_ptr<const formats::MorphClip> clip;  ///< null if the file has no morph targets
  std::vector<std::uint32_t> order;                ///< for each vertex of the surface the vertex of the file

  std::vector<mesh::Point> at_key(std::size_t key) const { return of_surface(clip->at_key(key)); }
  std::vector<mesh::Point> at_target(std::size_t target) const { return of_surface(clip->at_target(target)); }

private:
  std::vector<mesh::Point> of_surface(const std::vector<mesh::Point>& of_file) const;
};

/// glTF does not keep the vertex order. If the faces differ, vertices are matched by their rest positions.
/// Throws base::Error if the numbers of vertices or the rest positions differ.
MorphPositions morphs_of(const std::filesystem::path& file, const PosedSurface& of,
                         std::vector<std::string>& warnings);

}  // namespace viete::files
