// Link 1 of the frame: the affine maps of a cage's elements, of whatever kind, as one list of maps.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "deform/affine_map.h"
#include "deform/cage.h"
#include "deform/map_graph.h"
#include "deform/scheme.h"
#include "mesh/adjacency.h"

namespace viete::deform {

/// The maps of all elements of one kind. An element has one map or several, whose rows it takes the mean of:
/// those of its sides or corners. What is built at rest is constant; the cage must outlive it.
class ElementMaps {
public:
  virtual ~ElementMaps() = default;

  std::size_t count() const { return graph_.count(); }
  const MapGraph& graph() const { return graph_; }
  /// The element that a map belongs to; those of an element follow each other, elements in order.
  const std::vector<std::uint32_t>& owners() const { return owners_; }
  /// How much of its element's row each map is; they sum to one over an element.
  const std::vector<double>& shares() const { return shares_; }
  /// True if each element has one map.
  bool single() const { return single_; }
  /// The vertices of the cage that a map moves with.
  std::span<const std::uint32_t> vertices(std::size_t map) const { return vertices_.of(map); }

  /// Of these maps alone; the others stay as they are. Exactly I for a map none of whose vertices moved, and
  /// for a skipped one. center: of the element. maps.size() == count(), posed one position per cage vertex.
  virtual void compute(std::span<const mesh::Point> posed, const Vec3& origin,
                       std::span<const std::uint32_t> which, std::span<AffineMap> maps) const = 0;

protected:
  /// One map an element.
  ElementMaps(MapGraph graph, mesh::Adjacency vertices);
  ElementMaps(MapGraph graph, mesh::Adjacency vertices, std::vector<std::uint32_t> owners,
              std::vector<double> shares);

private:
  MapGraph graph_;
  mesh::Adjacency vertices_;
  std::vector<std::uint32_t> owners_;
  std::vector<double> shares_;
  bool single_;
};

}  // namespace viete::deform
