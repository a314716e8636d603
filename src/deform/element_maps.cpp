#include "deform/element_maps.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace viete::deform {

ElementMaps::ElementMaps(MapGraph graph, mesh::Adjacency vertices)
    : graph_(std::move(graph)),
      vertices_(std::move(vertices)),
      owners_(graph_.count()),
      shares_(graph_.count(), 1.0),
      single_(true) {
  std::iota(owners_.begin(), owners_.end(), 0u);
}

ElementMaps::ElementMaps(MapGraph graph, mesh::Adjacency vertices, std::vector<std::uint32_t> owners,
                         std::vector<double> shares)
    : graph_(std::move(graph)),
      vertices_(std::move(vertices)),
      owners_(std::move(owners)),
      shares_(std::move(shares)),
      single_(false) {}

}  // namespace viete::deform
