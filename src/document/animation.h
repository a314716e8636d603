// Mixes shapes of the model, and computes the pose at any frame of a timeline.
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
  SharedShape shape;  ///< null means the rest shape
  double factor;
};

/// Blends shapes in log space; `held` sets the translation of the result. If `held` is null, blends vertex
/// positions linearly. A vertex that is at rest in all terms stays exactly at rest.
SharedShape blended(const deform::LogSpace& space, std::span<const deform::LogTerm> terms,
                    const deform::Held* held, base::WorkerPool& pool);

/// If the rest shape and all terms have the same constant x, y or z, sets this coordinate of the positions.
void keep_flat(const std::vector<mesh::Point>& rest, std::span<const deform::LogTerm> terms,
               std::span<mesh::Point> positions);

/// Returns the rest shape plus the weighted shapes, in log space or (`straight`) linearly. A single shape
/// with factor 1 is returned unchanged. Throws base::Error if a shape does not fit the model.
SharedShape mixed(const deform::ShapeSpace& space, std::span<const ShapeTerm> terms, bool straight,
                  base::WorkerPool& pool, std::vector<std::string>* notes = nullptr);

/// Returns messages about problems in the shapes, for the user.
std::vector<std::string> shape_notes(std::span<const deform::ShapeReport> reports);

/// Caches the log vectors of poses of one cage and of shapes of one model. Not thread-safe.
class VectorCache {
public:
  /// Sets the cage, which may be null. Clears the cached poses if the cage changed.
  void follow(const std::shared_ptr<const deform::Cage>& cage);
  /// Sets the model. Clears the cached shapes if the model changed.
  void follow_model(const std::shared_ptr<const mesh::Surface>& model);
  /// Returns null without a cage.
  const std::shared_ptr<const deform::PoseSpace>& space() const { return space_; }
  /// Returns PoseSpace::vector(), or null without a cage. Caches the vector while other code uses the pose.
  std::shared_ptr<const deform::LogVector> of(const SharedPose& pose,
                                              std::span<const mesh::Vec3> turns_before = {});

  /// Requires a model. The first call creates the space, and throws base::Error like its constructor.
  const std::shared_ptr<const deform::ShapeSpace>& shapes(base::WorkerPool& pool);
  /// Returns ShapeSpace::vector() with `before` as the preceding shape; a null `shape` is the rest shape. The
  /// vector is cached while other code uses the shape. Throws base::Error like ShapeSpace::vector().
  std::shared_ptr<const deform::LogVector> of(const SharedShape& shape,
                                              const std::shared_ptr<const deform::LogVector>& before,
                                              base::WorkerPool& pool, deform::ShapeReport& report);
  /// Adds the cached shapes of another cache. Does nothing if the caches have different models.
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
    std::vector<VectorAfter> after;  // one vector for each preceding shape
  };
  std::shared_ptr<const mesh::Surface> model_;
  std::shared_ptr<const deform::ShapeSpace> shapes_;
  std::map<const void*, KnownShape> known_shapes_;
};

/// Computes the pose at any frame of a timeline. Immutable and thread-safe. At a key, returns exactly the
/// key's pose. If this pose has no whole turns, adds the whole turns nearest to the previous key.
///
/// Between keys, blends the cage in log space (see PoseSpace); if the timeline is linear, blends its vertex
/// positions. Always blends probes in log space. If the result is out of the drawable range, because `smooth`
/// easing can overshoot, returns the pose of the previous key.
class Animation {
public:
  /// The poses and shapes of the keys must belong to the cage and the model of `vectors`. Throws base::Error
  /// if a shape does not fit the model.
  Animation(const Timeline& timeline, VectorCache& vectors);

  /// Returns messages about the shapes of the keys, for the user.
  const std::vector<std::string>& notes() const { return notes_; }

  WholePose at(double frame) const;
  /// Uses `straight` instead of the setting of the timeline.
  WholePose at(double frame, bool straight) const;

private:
  WholePose key(std::size_t key) const;
  WholePose blend(const Moment& moment, bool straight) const;
  SharedShape blended_shape(const Moment& moment, bool straight) const;
  void add_shapes(VectorCache& vectors);
  void take_farthest(std::span<const mesh::Point> positions);

  Timeline timeline_;
  double farthest_ = most_drawn;  // the largest allowed coordinate, at least the largest of all keys
  std::shared_ptr<const deform::PoseSpace> space_;
  std::vector<std::shared_ptr<const deform::LogVector>> vectors_;  // one per key; null without a cage
  std::vector<deform::Held> held_;                                 // one per interval between keys

  std::shared_ptr<const deform::ShapeSpace> shapes_;  // null if no key has a shape
  std::vector<std::shared_ptr<const deform::LogVector>> shape_vectors_;
  std::vector<deform::Held> held_shapes_;
  std::vector<std::string> notes_;
};

}  // namespace viete::document
