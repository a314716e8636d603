// What a frame sums at one vertex, term by term.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "deform/binding.h"
#include "deform/cage_state.h"
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

}  // namespace viete::deform
