// Shapes of a model, and positions of any surface, from files of other programs: meshes, folders, sequences,
// point caches and morph targets.
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
  std::vector<std::string> warnings;         ///< one line each; also if the vertex order was recovered
  std::vector<std::filesystem::path> files;  ///< the files read
};

/// Each file gives a shape named after it: a model of any format with the same faces. A numbered name
/// (`pose_##.obj`) stands for the files of its sequence, a folder for its models that fit; a point cache of
/// several frames gives a shape per frame, and a glTF file with morph targets a shape per target.
///
/// Vertices may be reordered, as by formats that do not preserve order: they are matched by the corners of
/// the faces, whose order must be the same. Throws base::Error for the first vertex count, face or position
/// that does not fit, for no files, and for more shapes than a timeline holds. Thread-safe.
ImportedShapes read_shapes(std::span<const std::filesystem::path> files, const mesh::Surface& model,
                           base::Progress* progress = nullptr);

/// Throws base::Error if the shapes exceed a timeline's limit, or the memory with their vectors. place: the
/// file's name.
void check_shape_count(const std::string& place, std::size_t count, const mesh::Surface& model);

/// The surface that the positions are for.
struct PosedSurface {
  const mesh::Surface& surface;
  const char* what;  ///< "the cage"
};

/// Sorts in natural order: a2.obj before a10.obj.
void sort_by_numbers(std::vector<std::filesystem::path>& files);

/// Reads the models in a folder in natural order. `read` returns true if it uses the file; if it throws
/// base::Error, the file is skipped with a warning. Throws base::Error, "none is `wanted`", if no file is
/// used. progress may be null.
void read_folder(const std::filesystem::path& folder, const char* wanted, const char* advice,
                 const std::function<bool(const std::filesystem::path&)>& read,
                 std::vector<std::string>& warnings, base::Progress* progress);
/// The files of a numbered name. Throws base::Error if there are none.
std::vector<base::NumberedFile> files_of(const base::NumberedName& name);

/// Throws base::Error if positions exceed the range of GPUs or of the deformers. place: the file's name.
void check_places(const std::string& place, std::span<const mesh::Point> positions);
/// Throws base::Error unless the number of points equals the number of vertices.
void check_points(const std::string& place, std::size_t found, const PosedSurface& of);

/// Morph targets of a file as positions of a surface.
struct MorphPositions {
  std::shared_ptr<const formats::MorphClip> clip;  ///< null: none
  std::vector<std::uint32_t> order;                ///< the file's vertex for each vertex of the surface

  std::vector<mesh::Point> at_key(std::size_t key) const { return of_surface(clip->at_key(key)); }
  std::vector<mesh::Point> at_target(std::size_t target) const { return of_surface(clip->at_target(target)); }

private:
  std::vector<mesh::Point> of_surface(const std::vector<mesh::Point>& of_file) const;
};

/// glTF does not preserve vertex order: if the faces differ, vertices are matched by their rest position in
/// float. Throws base::Error: vertex counts or rest positions differ.
MorphPositions morphs_of(const std::filesystem::path& file, const PosedSurface& of,
                         std::vector<std::string>& warnings);

}  // namespace viete::files
