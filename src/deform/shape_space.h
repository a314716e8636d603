// Shapes of a model as vectors: of any triangle mesh, by the logs of its triangles. Between them models turn,
// where straight lines would collapse them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/branches.h"
#include "deform/cage.h"
#include "deform/log_space.h"
#include "deform/maps.h"
#include "mesh/surface.h"

namespace viete::deform {

/// How well a shape is told by its logs.
struct ShapeReport {
  std::size_t flat = 0;    ///< triangles without area at rest: they go with their corners
  std::size_t folded = 0;  ///< that turn against all their neighbours, or collapse: they take these' logs
  /// Pairs of neighbours whose logs are more than half a turn apart: between them the way is ambiguous.
  std::size_t torn = 0;
};

/// Takes shapes of one model (positions of its vertices) to vectors. One rotation of all, that of the mean
/// map by area, is the vector's whole turn; logs are of what is left (S. Kaji et al., Mathematical analysis
/// on affine maps for 2D shape interpolation, 2012, for maps in log space; R. W. Sumner et al., Mesh-based
/// inverse kinematics, 2005, for maps of triangles). Constant once it is made: thread-safe.
class ShapeSpace {
public:
  /// Throws base::Error if no triangle has area, see LogSpace; base::Cancelled.
  explicit ShapeSpace(const mesh::Surface& rest, base::WorkerPool& pool, base::Progress* progress = nullptr);

  /// Sums, shapes, and where these are held on their way.
  const LogSpace& logs() const { return logs_; }

  /// Branches are coherent over the mesh; those of the shape that comes before, if there is one, are
  /// continued, triangle by triangle. Throws base::Error if there is not one finite position per vertex. The
  /// same bits for any number of threads.
  LogVector vector(std::span<const mesh::Point> positions, base::WorkerPool& pool,
                   const LogVector* before = nullptr, ShapeReport* report = nullptr) const;

private:
  /// What of the mesh at rest tells maps and branches.
  struct Triangles {
    std::vector<mesh::Triangle> corners;
    std::vector<RestBasis> bases;
    std::vector<double> areas;  ///< in squares of the diagonal
    std::vector<std::uint8_t> flat;
    WeightedPairs neighbours;  ///< those of flat ones are joined
  };
  /// Of the maps to a shape.
  struct Splits {
    std::vector<sym3::Mat3<double>> rotations;
    std::vector<double> least, largest;  ///< stretches
    sym3::Mat3<double> sum{};            ///< of the maps, by area
  };
  class Folds;

  static Triangles triangles_of(const mesh::Surface& rest);
  static LogSpace logs_of(const mesh::Surface& rest, const Triangles& triangles, base::WorkerPool& pool,
                          base::Progress* progress);
  AffineMap map_to(std::span<const mesh::Point> positions, std::size_t t) const;
  static Vec3 mean_turn(const sym3::Mat3<double>& sum);
  Splits split(std::span<const mesh::Point> positions, base::WorkerPool& pool,
               std::vector<std::array<double, 9>>& logs) const;
  std::vector<std::uint8_t> raise(std::span<const mesh::Point> positions, Splits& splits,
                                  std::vector<std::array<double, 9>>& logs) const;
  std::vector<Vec3> turns_of(const Vec3& whole, std::span<const sym3::Mat3<double>> rotations,
                             const LogVector* before, base::WorkerPool& pool) const;
  void doubt(std::span<const Vec3> turns, std::vector<LogVector::Doubt>& doubts) const;

  Triangles triangles_;
  LogSpace logs_;
};

}  // namespace viete::deform
