// Positions that other files give a surface of the document: what they must fit, and morph targets.
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

}  // namespace viete::scene
