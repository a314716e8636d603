// The sums of a frame at selected vertices, computed in double from the rest positions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "deform/binding.h"
#include "deform/cage_state.h"
#include "deform/probe_layer.h"
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

/// Vertices at given points, with weights and offsets as in the staged frame.
struct BoundPart {
  Binding binding;
  std::size_t failed = 0;  ///< vertices without mean value coordinates
};
BoundPart bind_part(const Weigher& weigher, std::span<const mesh::Point> points);

/// Binds selected vertices of a binding, with shares multiplied by the mask. Weights along the surface are
/// read from the staged engine's data or, without them, from the tiles. Keeps references to its arguments.
class BoundVertices {
public:
  BoundVertices(const Weigher& weigher, const Binding& binding, const Mask& mask);
  Binding part(std::span<const std::size_t> vertices) const;

private:
  const Weigher& weigher_;
  const Binding& binding_;
  const Mask& mask_;
  std::vector<std::uint32_t> slots_;  // of the vertices, if weights are read from tiles
};

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
