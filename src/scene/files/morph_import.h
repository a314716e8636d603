// Positions for a surface of the document from other files: checks, and morph targets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mesh/formats/morphs.h"
#include "mesh/surface.h"

namespace viete::scene {

/// The surface that the positions are for.
struct PosedSurface {
  const mesh::Surface& surface;
  const char* what;  ///< "the cage"
};

/// Throws base::Error if positions exceed the range of GPUs or of the deformers. place: the file's name.
void check_places(const std::string& place, std::span<const mesh::Point> positions);
/// Throws base::Error unless the number of points equals the number of vertices.
void check_points(const std::string& place, std::size_t found, const PosedSurface& of);

/// Morph targets of a file as positions of a surface.
struct MorphPositions {
  std::shared_ptr<const mesh::MorphClip> clip;  ///< null: none
  std::vector<std::uint32_t> order;             ///< the file's vertex for each vertex of the surface

  std::vector<mesh::Point> at_key(std::size_t key) const { return of_surface(clip->at_key(key)); }
  std::vector<mesh::Point> at_target(std::size_t target) const { return of_surface(clip->at_target(target)); }

private:
  std::vector<mesh::Point> of_surface(const std::vector<mesh::Point>& of_file) const;
};

/// glTF does not preserve vertex order: if the faces differ, vertices are matched by their rest position in
/// float. Throws base::Error: vertex counts or rest positions differ.
MorphPositions morphs_of(const std::filesystem::path& file, const PosedSurface& of,
                         std::vector<std::string>& warnings);

}  // namespace viete::scene
