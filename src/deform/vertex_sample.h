// The sums of a frame at chosen vertices, computed in double from the rest positions.
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
    double weight;                 ///< with the vertex's share
    sym3::Sym3<double> stretch{};  ///< X = log S of its map; 0 where rows hold none
    Vec3 turn{};                   ///< Y = log R
    /// Where the handle's centre is in the file's units: in the pose; at rest where rows hold no logs.
    mesh::Point at{};
  };
  std::vector<Term> terms;       ///< of weights that are not 0, the largest first
  sym3::Sym3<double> stretch{};  ///< the sum of w X, of these in their order
  Vec3 turn{};                   ///< of w Y
  bool has_logs = false;         ///< else rows hold something else, and only weights tell
};

/// Weights are made anew in double, or where they live on the surface, as they are kept. mask may be null.
VertexSum vertex_sum(const Weigher& weigher, const Binding& binding, const Mask& mask, const Rows& rows,
                     std::size_t vertex);

/// visit(i, row of weights, share) for each of the points in turn. visit may throw. Returns how many have no
/// mean value coordinates.
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

/// visit(s, row) where weights live on the model's surface, of some of its vertices: the weights of the
/// staged engine, or else those of the tiles, as they are kept.
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

/// Vertices at these points, with weights and offsets as the staged frame has them.
struct BoundPart {
  Binding binding;
  std::size_t failed = 0;              ///< have no mean value coordinates
  std::vector<mesh::Point> offsets{};  ///< those at rest, while the binding's are a shape's
};
BoundPart bind_part(const Weigher& weigher, std::span<const mesh::Point> points);
/// With weights along the surface: of the error_sample vertices of tiles.sample.
BoundPart sampled_part(const Weigher& weigher, const TiledBinding& tiles,
                       std::span<const mesh::Point> points);

/// How far a frame of these rows, and of the layer unless that is null, is from double precision and exact
/// weights: the largest distance of the vertices of spread_vertices(n, error_sample), in diagonals of the
/// cage. ways: of the shape, see Engine::set_shape(). shown: where the frame has them, relative to the rows'
/// origin. Takes about a millisecond. Weights along the surface must be those of tiles.
double sampled_error(const Weigher& weigher, const Binding& binding, const Mask& mask,
                     std::span<const Vec3> ways, const Rows& rows, const ProbeLayer* layer,
                     std::span<const Vec3> shown);

/// The symmetric logs that at most `limit` vertices, spread evenly over the model, blend: what their
/// exponential is taken of. Empty if rows hold none. Throws base::Cancelled.
std::vector<sym3::Sym3<double>> sample_stretches(const Weigher& weigher, const Binding& binding,
                                                 const Mask& mask, const Rows& rows, std::size_t limit,
                                                 base::Progress* progress = nullptr);

}  // namespace viete::deform
