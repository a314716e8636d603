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

/// visit(vertex, row of weights) for at most `limit` vertices, spread evenly over the model. visit may throw.
template <class Visit>
void visit_sample(const Weigher& weigher, const Binding& binding, std::size_t limit, const Visit& visit) {
  const std::size_t count = std::min(binding.vertices, limit), handles = binding.handles;
  const auto vertex = [&](std::size_t s) { return std::min(s, count - 1) * binding.vertices / count; };
  std::vector<double> weights(bind_lanes * handles), row(handles);
  for (std::size_t s = 0; s < count; s += bind_lanes) {
    std::array<mesh::Point, bind_lanes> points;
    for (std::size_t l = 0; l < bind_lanes; ++l) points[l] = binding.rest[vertex(s + l)];
    weigher.weigh(points, weights);
    for (std::size_t l = 0; l < std::min(bind_lanes, count - s); ++l) {
      for (std::size_t j = 0; j < handles; ++j) row[j] = weights[j * bind_lanes + l];
      visit(vertex(s + l), row);
    }
  }
}

/// The symmetric logs that at most `limit` vertices, spread evenly over the model, blend: what their exponential is taken of.
/// Empty if logs is. Throws base::Cancelled.
std::vector<sym3::Sym3<double>> sample_stretches(const Weigher& weigher, const Binding& binding,
                                                 std::span<const MapLog> logs, std::size_t limit,
                                                 base::Progress* progress = nullptr);

}  // namespace viete::deform
