// The deformed model in double, for files: weights are made, blended and dropped block by block, so that
// those of all vertices never exist at once.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/binding.h"
#include "deform/cage.h"
#include "deform/log_maps.h"
#include "sym3/exp.h"

namespace viete::deform {

/// What a pose gives the sums of a vertex: of faces their logs, of mean values the cage's positions relative
/// to origin.
struct PosedHandles {
  Vec3 origin{0, 0, 0};
  std::vector<MapLog> logs;
  std::vector<Vec3> positions;
};

/// The staged links from the blend on, for all vertices of a binding: positions.size() of them. Returns how
/// far the method's exponentials are from those of method `fast`, which is exact to 1e-15: the largest
/// relative difference, Frobenius norm; infinity where one is not a number, 0 for `fast` and mean values.
double place_vertices(const Binding& binding, const PosedHandles& posed, sym3::Method method,
                      std::span<mesh::Point> positions);

struct ExactModel {
  std::vector<mesh::Point> positions;  ///< one per vertex
  LogReport report;                    ///< as Deformer::report()
  std::vector<std::string> warnings;   ///< as Binding::warnings
  double exp_error = 0;                ///< of the worst vertex, see place_vertices()
};

/// Agrees with the staged frame of Deformer to 1e-12 of the cage's diagonal (its weights come from vector
/// code, see Weigher); the same bits for any number of threads. Memory: the positions, and a megabyte or so
/// for each thread, more for cages of more than 10,000 elements. Throws base::Error when the pose has not one
/// position per cage vertex or the model no vertices, and base::Cancelled. progress may be null.
ExactModel deform_exactly(std::span<const mesh::Point> rest, const Cage& cage, Weighting weighting,
                          const Pose& pose, sym3::Method method, base::WorkerPool& pool,
                          base::Progress* progress = nullptr);

}  // namespace viete::deform
