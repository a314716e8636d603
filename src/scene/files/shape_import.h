// Shapes of a model, and positions that other files give a surface of the document: what they must fit, and
// morph targets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/formats/morphs.h"
#include "mesh/surface.h"
#include "scene/document/document_state.h"

namespace viete::scene {

/// What positions are to be of.
struct PosedSurface {
  const mesh::Surface& surface;
  const char* what;  ///< "the cage"
};

/// Throws base::Error where a graphics card, or the engines, cannot hold them. place: of what file.
void check_places(const std::string& place, std::span<const mesh::Point> positions);
/// Throws base::Error where so many points are not one a vertex.
void check_points(const std::string& place, std::size_t found, const PosedSurface& of);

/// Morph targets of a file as positions of a surface.
struct MorphPositions {
  std::shared_ptr<const mesh::MorphClip> clip;  ///< null: none
  std::vector<std::uint32_t> order;             ///< of each vertex of the surface: the file's vertex

  std::vector<mesh::Point> at_key(std::size_t key) const { return of_surface(clip->at_key(key)); }
  std::vector<mesh::Point> at_target(std::size_t target) const { return of_surface(clip->at_target(target)); }

private:
  std::vector<mesh::Point> of_surface(const std::vector<mesh::Point>& of_file) const;
};

/// glTF keeps no order of the vertices: where faces differ they are told by where they are at rest, in
/// floats. Throws base::Error: another number of vertices, or other places at rest.
MorphPositions morphs_of(const std::filesystem::path& file, const PosedSurface& of,
                         std::vector<std::string>& warnings);

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
