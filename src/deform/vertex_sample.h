// The sums of a frame at selected vertices, computed in double precision from the rest positions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "deform/probe_layer.h"
#include "pose/cage_state.h"
#include "sym3/sym3.h"
#include "weights/binding.h"
#include "weights/weigher.h"

namespace viete::deform {

using mesh::Vec3;

struct VertexSum {
  struct Term {
    std::uint32_t handle;
    double weight;                 ///< weight times the vertex's share
    sym3::Sym3<double> stretch{};  ///< X = log S of the handle's map; 0 if rows have no logs
    Vec3 turn{};                   ///< Y = log R
    /// The handle's centre in the file's units: posed, or at rest if rows have no logs.
    mesh::Point at{};
  };
  std::vector<Term> terms;       ///< terms with nonzero weight, largest first
  sym3::Sym3<double> stretch{};  ///< sum of weight * X, over terms in order
  Vec3 turn{};                   ///< sum of weight * Y
  bool has_logs = false;         ///< false: rows have another form, and all X and Y are 0
};

/// Computes the sum at a vertex. Reads only weights along the surface from `binding`. `mask` may be null.
VertexSum vertex_sum(const weights::Weigher& weigher, const weights::Binding& binding,
                     const weights::Mask& mask, const pose::Rows& rows, std::size_t vertex);

/// Returns the error of a frame: the largest distance of a vertex from its exact position, relative to the
/// cage's diagonal. Compares the vertices of spread_vertices(n, error_sample). Exact positions are computed
/// in double precision from exact weights. If `layer` is not null, it moves them. `displacements` are the
/// shape's displacements, see Engine::set_shape(). `shown` are the frame's positions of the compared
/// vertices, relative to the rows' origin. For weights along the surface, binding.tiles must not be null.
double sampled_error(const weights::Weigher& weigher, const weights::Binding& binding,
                     const weights::Mask& mask, std::span<const Vec3> displacements, const pose::Rows& rows,
                     const ProbeLayer* layer, std::span<const Vec3> shown);

/// Returns the blended logs of stretches, the input of the exponential, at up to `limit` vertices spread
/// evenly over the model, without tips. Empty if rows have no logs. Throws base::Cancelled.
std::vector<sym3::Sym3<double>> sample_stretches(const weights::Weigher& weigher,
                                                 const weights::Binding& binding, const weights::Mask& mask,
                                                 const pose::Rows& rows, std::size_t limit,
                                                 base::Progress* progress = nullptr);

}  // namespace viete::deform
