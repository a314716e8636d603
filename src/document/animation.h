// Mixes shapes of the model, and blends keys in log space to the pose at any frame of a timeline.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "deform/pose_space.h"
#include "deform/shape_space.h"
#include "document/document_state.h"
#include "document/timeline.h"

namespace viete::document {

struct ShapeTerm {
  SharedShape shape;  ///< null: rest
  double factor;
};

/// The blended shape, positioned by `held`; if `held` is null, vertices move on straight lines. A vertex that
/// is at rest in all terms stays exactly at rest.
SharedShape blended(const deform::LogSpace& space, std::span<const deform::LogTerm> terms,
                    const deform::Held* held, base::WorkerPool& pool);

/// Removes rounding errors across a coordinate plane that contains the rest shape and all terms.
void keep_flat(const std::vector<mesh::Point>& rest, std::span<const deform::LogTerm> terms,
               std::span<mesh::Point> positions);

/// The rest shape plus the weighted shapes, in log space or linearly. A single shape with factor 1, or no
/// shape, is returned bit for bit. Throws base::Error if a shape does not fit the model.
SharedShape mixed(const deform::ShapeSpace& space, std::span<const ShapeTerm> terms, bool straight,
                  base::WorkerPool& pool, std::vector<std::string>* notes = nullptr);

/// Messages about shapes for the user, one line each.
std::vector<std::string> shape_notes(std::span<const deform::ShapeReport> reports);

/// Caches the log vectors of poses of one cage and of shapes of one model. Not thread-safe.
class VectorCache {
public:
  /// A different cage, or null, clears the cached poses.
  void follow(const std::shared_ptr<const deform::Cage>& cage);
  /// A different model clears its cached shapes.
  void follow_model(const std::shared_ptr<const mesh::Surface>& model);
  /// Null without a cage.
  const std::shared_ptr<const deform::PoseSpace>& space() const { return space_; }
  /// See PoseSpace::vector(). Null without a cage. Cached as long as the pose is in use elsewhere.
  std::shared_ptr<const deform::LogVector> of(const SharedPose& pose,
                                              std::span<const mesh::Vec3> turns_before = {});

  /// Created on the first call. Requires a model. Throws base::Error: see ShapeSpace.
  const std::shared_ptr<const deform::ShapeSpace>& shapes(base::WorkerPool& pool);
  /// Branches continue those of the previous shape; null: the rest shape. Cached as long as the shape is in
  /// use elsewhere. Throws base::Error: see ShapeSpace::vector().
  std::shared_ptr<const deform::LogVector> of(const SharedShape& shape,
                                              const std::shared_ptr<const deform::LogVector>& before,
                                              base::WorkerPool& pool, deform::ShapeReport& report);
  /// Merges the shapes that another cache of the same model has.
  void take(VectorCache&& others);

private:
  struct Known {
    SharedPose pose;
    std::vector<mesh::Vec3> turns_before;
    std::shared_ptr<const deform::LogVector> vector;
  };
  std::shared_ptr<const deform::Cage> cage_;
  std::shared_ptr<const deform::PoseSpace> space_;
  std::map<const WholePose*, Known> known_;

  struct VectorAfter {
    std::shared_ptr<const deform::LogVector> before, vector;
    deform::ShapeReport report;
  };
  struct KnownShape {
    SharedShape shape;
    std::vector<VectorAfter> after;  // one for each previous shape
  };
  std::shared_ptr<const mesh::Surface> model_;
  std::shared_ptr<const deform::ShapeSpace> shapes_;
  std::map<const void*, KnownShape> known_shapes_;
};

/// The poses of a timeline at any frame. Immutable and thread-safe; the result does not depend on the frames
/// evaluated before. At a key's frame it is that key's pose, bit for bit. A pose without whole turns takes
/// those nearest to the previous key.
///
/// Between keys the cage follows the blended logs, see PoseSpace; in a linear timeline its vertices move on
/// straight lines. Probes are always blended by their logs. If the result leaves the drawable range, as
/// `smooth` may when it overshoots, the previous key's pose is used.
class Animation {
public:
  /// The timeline must have keys of this cage, and shapes of this model if keys have shapes. Throws
  /// base::Error if a shape does not fit the model.
  Animation(const Timeline& timeline, VectorCache& vectors);

  /// Messages about the keys' shapes for the user, one line each.
  const std::vector<std::string>& notes() const { return notes_; }

  WholePose at(double frame) const;
  /// As above; `straight` replaces the setting of the timeline.
  WholePose at(double frame, bool straight) const;

private:
  WholePose key(std::size_t key) const;
  WholePose blend(const Moment& moment, bool straight) const;
  SharedShape blended_shape(const Moment& moment, bool straight) const;
  void add_shapes(VectorCache& vectors);
  void take_farthest(std::span<const mesh::Point> positions);

  Timeline timeline_;
  double farthest_ = most_drawn;  // largest coordinate allowed; raised if a key exceeds it
  std::shared_ptr<const deform::PoseSpace> space_;
  std::vector<std::shared_ptr<const deform::LogVector>> vectors_;  // one per key; null without a cage
  std::vector<deform::Held> held_;                                 // one per interval between keys

  std::shared_ptr<const deform::ShapeSpace> shapes_;  // null: no key has a shape
  std::vector<std::shared_ptr<const deform::LogVector>> shape_vectors_;
  std::vector<deform::Held> held_shapes_;
  std::vector<std::string> notes_;
};

}  // namespace viete::document
