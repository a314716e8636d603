// Which maps of a cage are neighbours: what branches of rotations are coherent along.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "deform/cage.h"

namespace viete::deform {

/// The maps of one kind of element as a graph. Its connected components are most often the cage's parts;
/// parts that touch at a vertex alone are one component of elements that belong to vertices.
struct MapGraph {
  std::vector<mesh::Edge> edges;            ///< pairs of maps i < j, sorted, each once; none of a skipped map
  std::vector<std::uint8_t> skipped;        ///< 1: nothing at rest tells the map, it is the identity
  std::vector<std::uint32_t> roots;         ///< of each component its centre, where branches start
  std::vector<std::uint32_t> component;     ///< of each map, a place in roots; skipped: roots.size()
  std::vector<std::uint32_t> part_of;       ///< of each component the cage's part whose turns it follows
  std::vector<std::uint32_t> component_of;  ///< of each part of the cage the component that tells its turns

  std::size_t count() const { return skipped.size(); }
};

/// Of the cage's triangles.
MapGraph face_graph(const Cage& cage);

/// Of the cage's vertices: neighbours share a polygon (of more than 16 corners, an edge of it), or a place.
/// Vertices of no polygon are skipped.
MapGraph vertex_graph(const Cage& cage);

/// Of any maps: pairs that are neighbours, in any order and number; part_of(map) is a part of the cage, or
/// cage.roots.size() if the map is of none.
MapGraph map_graph(const Cage& cage, std::vector<mesh::Edge> pairs, std::vector<std::uint8_t> skipped,
                   const std::function<std::uint32_t(std::uint32_t)>& part_of);

}  // namespace viete::deform
