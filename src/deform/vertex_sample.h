// The sums of a frame at selected vertices, computed in double from the rest positions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/progress.h"
#include "deform/binding.h"
#include "deform/cage_state.h"
#include "deform/frame_vertex.h"
#include "deform/probe_layer.h"
#include "deform/tiled_binding.h"
#include "deform/weigher.h"
#include "sym3/sym3.h"

namespace viete::deform {

struct VertexSum {
  struct Term {
    std::uint32_t handle;
    double weight;                 ///< weight times the vertex's share
    sym3::Sym3<double> stretch{};  ///< X = log S of its map; 0 if rows have none
    Vec3 turn{};                   ///< Y = log R
    /// The handle's centre in the file's units: posed; at rest if rows have no logs.
    mesh::Point at{};
  };
  std::vector<Term> terms;       ///< terms with nonzero weight, largest first
  sym3::Sym3<double> stretch{};  ///< the sum of w X, over terms in order
  Vec3 turn{};                   ///< the sum of w Y
  bool has_logs = false;         ///< false: rows have another form; only weights are valid
};

/// Recomputes weights in double; weights along the surface are used as stored. mask may be null.
VertexSum vertex_sum(const Weigher& weigher, const Binding& binding, const Mask& mask, const Rows& rows,
                     std::size_t vertex);

/// Calls visit(i, row of weights, share) for each point in order. visit may throw. Returns the number of
/// points without mean value coordinates.
template <class Visit>
std::size_t visit_weights(const Weigher& weigher, std::span<const mesh::Point> points, const Visit& visit) {
  const std::size_t handles = weigher.handles();
  std::vector<double> weights(weigher.scratch_size()), row(handles);
  std::size_t failed = 0;
  for (std::size_t s = 0; s < points.size(); s += bind_lanes) {
    const std::size_t count = std::min(bind_lanes, points.size() - s);
    std::array<mesh::Point, bind_lanes> lanes;
    for (std::size_t l = 0; l < bind_lanes; ++l) lanes[l] = points[s + std::min(l, count - 1)];
    Weigher::LaneShares shares;
    const unsigned lost = weigher.weigh(lanes, weights, shares);
    for (std::size_t l = 0; l < count; ++l) {
      for (std::size_t j = 0; j < handles; ++j) row[j] = weights[j * bind_lanes + l];
      failed += lost >> l & 1;
      visit(s + l, row, shares[l]);
    }
  }
  return failed;
}

/// For weights along the surface: calls visit(s, row) for some vertices with the stored weights, those of the
/// staged engine or, if it has none, those of the tiles.
template <class Visit>
void visit_kept_weights(const Binding& binding, std::span<const std::size_t> vertices, const Visit& visit) {
  std::vector<double> row(binding.handles);
  const auto slots = binding.weights.empty() ? slots_of(binding.tiles->leaves) : std::vector<std::uint32_t>();
  for (std::size_t s = 0; s < vertices.size(); ++s) {
    if (slots.empty()) {
      const auto from = binding.weights.begin() + static_cast<std::ptrdiff_t>(vertices[s] * binding.handles);
      std::copy_n(from, binding.handles, row.begin());
    } else {
      binding.tiles->kept_row(slots[vertices[s]], row);
    }
    visit(s, row);
  }
}

/// Vertices at given points, with weights and offsets as in the staged frame.
struct BoundPart {
  Binding binding;
  std::size_t failed = 0;              ///< vertices without mean value coordinates
  std::vector<mesh::Point> offsets{};  ///< offsets at rest, while the binding has those of a shape
};
BoundPart bind_part(const Weigher& weigher, std::span<const mesh::Point> points);
/// For weights along the surface: the error_sample vertices of tiles.sample.
BoundPart sampled_part(const Weigher& weigher, const TiledBinding& tiles,
                       std::span<const mesh::Point> points);

/// Error of a frame of these rows, and of the layer unless null, against double precision and exact weights:
/// the largest distance at the vertices of spread_vertices(n, error_sample), in diagonals of the cage. ways:
/// displacements of the shape, see Engine::set_shape(). shown: their positions in the frame, relative to the
/// rows' origin. Takes about a millisecond. Weights along the surface must be those of tiles.
double sampled_error(const Weigher& weigher, const Binding& binding, const Mask& mask,
                     std::span<const Vec3> ways, const Rows& rows, const ProbeLayer* layer,
                     std::span<const Vec3> shown);

/// The blended symmetric logs, input of the exponential, at no more than `limit` vertices spread evenly over
/// the model. Empty if rows have none. Throws base::Cancelled.
std::vector<sym3::Sym3<double>> sample_stretches(const Weigher& weigher, const Binding& binding,
                                                 const Mask& mask, const Rows& rows, std::size_t limit,
                                                 base::Progress* progress = nullptr);

}  // namespace viete::deform
