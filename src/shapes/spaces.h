// Shapes of a model and poses of a cage as logs of triangles' maps, so that in-between shapes rotate and do
// not collapse.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/triangulation.h"
#include "pose/branches.h"
#include "pose/cage.h"
#include "pose/maps.h"
#include "shapes/log_space.h"
#include "weights/coarse_model.h"

namespace viete::shapes {

/// How well the logs represent a shape.
struct ShapeReport {
  std::size_t flat = 0;    ///< triangles without area at rest
  std::size_t folded = 0;  ///< triangles that collapse or flip; their logs are means of neighbours' logs
  /// Pairs of neighbours whose logs differ by more than half a turn. Blends between such logs are ambiguous.
  std::size_t torn = 0;
  bool coarse = false;  ///< true: the counts are those of the CoarseModel
};

/// Converts shapes of one model, given as vertex positions, to vectors. A vector stores the rotation of
/// the whole shape, which is that of the area-weighted mean of the triangles' maps, and for each triangle the
/// log of its map relative to this rotation. Sources: S. Kaji et al., Mathematical analysis on affine maps
/// for 2D shape interpolation, 2012; R. W. Sumner et al., Mesh-based inverse kinematics, 2005. Thread-safe.
///
/// If the model needs_coarse_model() and has few small parts, the log space is that of the CoarseModel. Its
/// triangles rotate the clusters, and the vertices follow their clusters: see R. W. Sumner et al., Embedded
/// deformation for shape manipulation, 2007. LogVector::details reproduce the shape up to rounding, except at
/// clusters beside collapsed clusters: there, rounding can decide the rotation.
class ShapeSpace {
public:
  /// Throws base::Error if no triangle has area, or if LogSpace() throws it. Throws base::Cancelled.
  explicit ShapeSpace(const mesh::Surface& rest, base::WorkerPool& pool, base::Progress* progress = nullptr)
      : ShapeSpace(rest, coarse_of(rest, pool, progress), {}, pool, progress) {}
  /// Returns a space of the same model in which couplings join near parts, see vertex_couplings(), for poses
  /// that do not determine the motion of each part. If the model has many small parts, it has a coarse model.
  /// Returns nothing if that space would be this one.
  std::optional<ShapeSpace> joined(base::WorkerPool& pool) const;

  /// The log space of the coarse model or, without one, of the model's vertices, then the centers of its
  /// polygons, see mesh::split_unsettled().
  const LogSpace& logs() const { return logs_; }
  const std::vector<mesh::Point>& rest() const { return rest_; }
  /// Returns the positions of the vertices of logs() for positions of the model's vertices.
  std::vector<mesh::Point> solved(std::span<const mesh::Point> positions, base::WorkerPool& pool) const;
  LogVector at_rest() const;
  /// Returns the displacement of each vertex of the model.
  const std::vector<Vec3>& displacements(const LogVector& v) const {
    return coarse_ ? v.fine_displacements : v.displacements;
  }

  /// Converts a shape to a vector. Of the many logs of a rotation, takes the log nearest to the triangle's
  /// log in `before` (the preceding shape's vector, or null). Makes the logs of neighbours coherent. Throws
  /// base::Error unless each vertex has a finite position. Results do not depend on the number of threads.
  LogVector vector(std::span<const mesh::Point> positions, base::WorkerPool& pool,
                   const LogVector* before = nullptr, ShapeReport* report = nullptr) const;

  /// Compute the model's shape, like the functions of LogSpace.
  void shape(std::span<const LogTerm> terms, const AnchorWeights& anchors, base::WorkerPool& pool,
             LogSpace::Work& work, std::span<mesh::Point> positions) const;
  void linear(std::span<const LogTerm> terms, std::span<mesh::Point> positions) const;

  /// The coarse model, or null if the log space is that of the model.
  const weights::CoarseModel* coarse() const { return coarse_ ? &*coarse_ : nullptr; }
  /// Moves `vertices` of the model with the clusters at `posed`, and adds the sum of the details of `terms`.
  /// Requires a coarse model.
  void follow(std::span<const LogTerm> terms, std::span<const mesh::Point> posed, base::WorkerPool& pool,
              std::span<mesh::Point> positions, std::span<const std::uint32_t> vertices) const;

private:
  /// Data of the rest mesh for maps and branches.
  struct Triangles {
    std::vector<mesh::Triangle> corners;
    std::vector<pose::RestBasis> bases;
    std::vector<double> areas;  ///< relative to the squared diagonal
    std::vector<std::uint8_t> flat;
    pose::WeightedPairs neighbours;  ///< a flat triangle's neighbours are neighbours of each other
  };
  class Folds;

  ShapeSpace(const mesh::Surface& rest, std::optional<weights::CoarseModel> coarse,
             std::span<const weights::Coupling> couplings, base::WorkerPool& pool, base::Progress* progress);
  static std::optional<weights::CoarseModel> coarse_of(const mesh::Surface& rest, base::WorkerPool& pool,
                                                       base::Progress* progress);
  static Triangles triangles_of(const mesh::Surface& rest);
  pose::AffineMap map_to(std::span<const mesh::Point> positions, std::size_t t) const;
  std::vector<pose::MapSplit> split(std::span<const mesh::Point> positions, base::WorkerPool& pool,
                                    sym3::Mat3<double>& sum) const;
  std::vector<std::uint8_t> raise(std::span<const mesh::Point> positions,
                                  std::vector<pose::MapSplit>& splits) const;
  std::vector<Vec3> turns_of(const Vec3& whole, std::span<const sym3::Mat3<double>> rotations,
                             const LogVector* before, base::WorkerPool& pool) const;
  void doubt(std::span<const Vec3> turns, std::vector<LogVector::Doubt>& doubts) const;
  LogVector solved_vector(std::span<const mesh::Point> positions, base::WorkerPool& pool,
                          const LogVector* before, ShapeReport* report) const;
  std::vector<weights::RigidMotion> motions(std::span<const mesh::Point> posed, base::WorkerPool& pool) const;
  template <class Use>
  void move_with_clusters(std::span<const mesh::Point> posed, std::span<const std::uint32_t> vertices,
                          base::WorkerPool& pool, const Use& use) const;

  std::vector<mesh::Point> rest_;
  std::optional<weights::CoarseModel> coarse_;  // the other members are of this model
  mesh::CenterSplit split_;
  Triangles triangles_;
  LogSpace logs_;
};

/// Converts poses of one cage to vectors and back, including the whole turns of each part. Uses the cage's
/// elements, even if a binding uses vertices. Logs cannot represent whole turns about another axis than the
/// axis of the part's rotation, see choose_branches(). LogVector::wholes stores such turns. Thread-safe.
class PoseSpace {
public:
  /// Throws base::Error as LogSpace does.
  explicit PoseSpace(std::shared_ptr<const pose::Cage> cage);

  const pose::Cage& cage() const { return *cage_; }
  /// The log space, for sums of vectors and the anchors of a moving pose.
  const LogSpace& logs() const { return logs_; }
  /// Converts a pose to a vector. If the pose has no turns, chooses the turns nearest to `turns_before`, the
  /// turns of the preceding pose (0 if missing). Throws base::Error if the number of positions is wrong.
  LogVector vector(const pose::Pose& pose, std::span<const Vec3> turns_before = {}) const;
  /// Returns the pose of the sum of `terms`.
  pose::Pose pose(std::span<const LogTerm> terms, const AnchorWeights& anchors) const;
  /// Returns the linear sum of the poses' positions: every vertex moves on a straight line.
  pose::Pose linear(std::span<const LogTerm> terms) const;

private:
  std::vector<Vec3> take_wholes(std::span<const pose::AffineMap> maps, std::span<const pose::MapSplit> splits,
                                const pose::LogReport& report, std::vector<pose::MapLog>& logs) const;
  std::vector<Vec3> turns(std::span<const LogTerm> terms) const;

  std::shared_ptr<const pose::Cage> cage_;
  LogSpace logs_;
};

}  // namespace viete::shapes
