// The deformed model in double, for files: weights are made, blended and dropped block by block, so that
// those of all vertices never exist at once.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/binding.h"
#include "deform/cage_state.h"
#include "deform/probe.h"
#include "sym3/exp.h"

namespace viete::deform {

/// The staged links from the blend on, for all vertices of a binding: positions.size() of them. Returns how
/// far the method's exponentials are from those of method `fast`, which is exact to 1e-15: the largest
/// relative difference, Frobenius norm; infinity where one is not a number, 0 for `fast` and where there are
/// no exponentials.
double place_vertices(const Binding& binding, const Rows& rows, sym3::Method method,
                      std::span<mesh::Point> positions);

struct ExactModel {
  std::vector<mesh::Point> positions;  ///< one per vertex
  LogReport report;                    ///< as CageState::report()
  std::vector<std::string> warnings;   ///< as Binding::warnings
  double exp_error = 0;                ///< of the worst vertex, see place_vertices()
};

/// Agrees with the staged engine to 1e-12 of the cage's diagonal (its weights come from vector
/// code, see Weigher); the same bits for any number of threads. Memory: the positions, and a megabyte or so
/// for each thread, more for cages of more than 10,000 elements; with
/// weights along the surface those of all vertices. Throws base::Error when the pose has not one
/// position per cage vertex or the model no vertices, and base::Cancelled. progress may be null; a mask has
/// one share a vertex. cage must not be null. Probes are a layer upon it, see ProbeLayer.
ExactModel deform_exactly(const mesh::Surface& model, std::shared_ptr<const Cage> cage, const Scheme& scheme,
                          const Pose& pose, sym3::Method method, base::WorkerPool& pool,
                          base::Progress* progress = nullptr, const Mask& mask = nullptr,
                          const Probes& probes = {});

}  // namespace viete::deform
