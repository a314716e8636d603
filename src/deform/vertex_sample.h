// What the frame blends at some vertices, or at all of them, made anew in double from the rest positions.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/progress.h"
#include "deform/binding.h"
#include "deform/log_maps.h"
#include "deform/weigher.h"
#include "sym3/sym3.h"

namespace viete::deform {

/// At most `limit` vertices, spread evenly over the model.
std::vector<std::size_t> spread_vertices(const Binding& binding, std::size_t limit);

/// visit(vertex, row of weights) for each of the vertices in turn. visit may throw.
template <class Visit>
void visit_vertices(const Weigher& weigher, const Binding& binding, std::span<const std::size_t> vertices,
                    const Visit& visit) {
  const std::size_t handles = binding.handles;
  std::vector<double> weights(weigher.room()), row(handles);
  for (std::size_t s = 0; s < vertices.size(); s += bind_lanes) {
    std::array<mesh::Point, bind_lanes> points;
    for (std::size_t l = 0; l < bind_lanes; ++l) {
      points[l] = binding.rest[vertices[std::min(s + l, vertices.size() - 1)]];
    }
    weigher.weigh(points, weights);
    for (std::size_t l = 0; l < std::min(bind_lanes, vertices.size() - s); ++l) {
      for (std::size_t j = 0; j < handles; ++j) row[j] = weights[j * bind_lanes + l];
      visit(vertices[s + l], row);
    }
  }
}

/// Weights and offsets of these vertices alone, as the staged frame has them.
Binding part_of(const Weigher& weigher, const Binding& binding, std::span<const std::size_t> vertices);

/// The symmetric logs that at most `limit` vertices, spread evenly over the model, blend: what their
/// exponential is taken of. Empty if logs is. Throws base::Cancelled.
std::vector<sym3::Sym3<double>> sample_stretches(const Weigher& weigher, const Binding& binding,
                                                 std::span<const MapLog> logs, std::size_t limit,
                                                 base::Progress* progress = nullptr);

}  // namespace viete::deform
