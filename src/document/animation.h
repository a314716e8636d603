// Mixes shapes of the model. Computes the pose at each frame of a timeline.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "document/document_state.h"
#include "document/timeline.h"
#include "shapes/spaces.h"

namespace viete::document {

struct ShapeTerm {
  SharedShape shape;  ///< null is the rest shape
  double factor;
};

/// Returns the sum of the terms. If `anchors` is null, blends vertex positions linearly. Otherwise blends in
/// log space, and applies shapes::keep_anchors(). A vertex that is at rest in all terms stays exactly at
/// rest.
SharedShape blended(const shapes::ShapeSpace& space, std::span<const shapes::LogTerm> terms,
                    const shapes::AnchorWeights* anchors, base::WorkerPool& pool);

/// If all rest vertices have the same x, and no term changes x, sets x of all positions to exactly this
/// value. Does the same for y and z.
void keep_flat(const shapes::ShapeSpace& space, std::span<const shapes::LogTerm> terms,
               std::span<mesh::Point> positions);

/// Returns the rest shape plus the weighted shapes, blended linearly if `linear`, otherwise in log space.
/// Returns a single shape of factor 1 unchanged. Throws base::Error if a shape does not fit the model.
SharedShape mixed(const shapes::ShapeSpace& space, std::span<const ShapeTerm> terms, bool linear,
                  base::WorkerPool& pool, std::vector<std::string>* notes = nullptr);

/// Returns messages about problems in the shapes, for the user.
std::vector<std::string> shape_notes(std::span<const shapes::ShapeReport> reports);

/// Caches the log vectors (shapes::LogVector) of one cage's poses and of one model's shapes. Not thread-safe.
class VectorCache {
public:
  /// Sets the cage, which may be null. Clears the cached poses if the cage changed.
  void follow(const std::shared_ptr<const pose::Cage>& cage);
  /// Sets the model. Clears the cached shapes if the model changed.
  void follow_model(const std::shared_ptr<const mesh::Surface>& model);
  /// Returns the pose space of the cage, or null without a cage.
  const std::shared_ptr<const shapes::PoseSpace>& space() const { return space_; }
  /// Returns PoseSpace::vector(); null without a cage. Caches the result while other code owns the pose.
  std::shared_ptr<const shapes::LogVector> of(const SharedPose& pose,
                                              std::span<const mesh::Vec3> turns_before = {});

  /// Returns the shape space. Requires a model. The first call creates the space and can throw base::Error.
  const std::shared_ptr<const shapes::ShapeSpace>& shapes(base::WorkerPool& pool);
  /// Returns ShapeSpace::vector() of the shape, and throws its errors. A null shape is the rest shape.
  /// `before` is the vector of the preceding shape. Caches the result while other code owns the shape.
  std::shared_ptr<const shapes::LogVector> of(const SharedShape& shape,
                                              const std::shared_ptr<const shapes::LogVector>& before,
                                              base::WorkerPool& pool, shapes::ShapeReport& report);
  /// Adds the cached shapes of `others`. If the two caches have different models, does nothing.
  void take(VectorCache&& others);

private:
  struct Known {
    SharedPose pose;
    std::vector<mesh::Vec3> turns_before;
    std::shared_ptr<const shapes::LogVector> vector;
  };
  std::shared_ptr<const pose::Cage> cage_;
  std::shared_ptr<const shapes::PoseSpace> space_;
  std::map<const WholePose*, Known> known_;

  struct VectorAfter {
    std::shared_ptr<const shapes::LogVector> before, vector;
    shapes::ShapeReport report;
  };
  struct KnownShape {
    SharedShape shape;
    std::vector<VectorAfter> after;  // one vector for each preceding shape
  };
  std::shared_ptr<const mesh::Surface> model_;
  std::shared_ptr<const shapes::ShapeSpace> shapes_;
  std::map<const void*, KnownShape> known_shapes_;
};

/// Returns `base` plus the weighted poses, which must fit the cage and the model of `vectors`. Probes are
/// always blended in log space. Upon the rest pose, a single pose of weight 1 is exact.
WholePose mixed_upon(VectorCache& vectors, const SharedPose& base, std::span<const NamedPose> poses,
                     bool linear);

/// Computes the pose at any frame of a timeline. At a key, returns the key's exact pose. If this pose has no
/// Pose::turns, sets the turns that are nearest to the turns of the previous key. Immutable and thread-safe.
///
/// Between keys, blends the cage and the shape in log space (see PoseSpace). If the timeline is linear,
/// blends vertex positions instead. Always blends probes in log space. The `smooth` easing can overshoot: if
/// the result is out of the drawable range, returns the pose of the previous key.
///
/// Adds the poses of the channels with mixed_upon(), unless the sum is out of the drawable range. Without
/// pose keys, adds them to the rest pose.
class Animation {
public:
  /// The poses and shapes of all keys must fit the cage and the model of `vectors`. Throws base::Error if a
  /// shape does not fit the model.
  Animation(const Timeline& timeline, VectorCache& vectors);

  /// Returns messages about problems in the keys' shapes, for the user.
  const std::vector<std::string>& notes() const { return notes_; }

  WholePose at(double frame) const { return at(frame, timeline_.linear); }
  /// Returns the pose at a frame. Uses `linear` instead of the timeline's setting. If `base` is not null and
  /// there are channels, `*base` gets the pose without them.
  WholePose at(double frame, bool linear, SharedPose* base = nullptr) const;

private:
  WholePose pose_of_keys(double frame, bool linear) const;
  WholePose key(std::size_t key) const;
  WholePose blend(const Moment& moment, bool linear) const;
  SharedShape blended_shape(const Moment& moment, bool linear) const;
  void add_shapes(VectorCache& vectors);
  void take_farthest(const WholePose& pose);

  Timeline timeline_;
  double farthest_ = most_drawn;  // largest allowed coordinate: max(most_drawn, all keys' coordinates)
  std::shared_ptr<const shapes::PoseSpace> space_;
  std::vector<std::shared_ptr<const shapes::LogVector>> vectors_;  // one per key; null without a cage
  std::vector<shapes::AnchorWeights> anchors_;                     // one per interval between keys

  VectorCache channels_;                              // with the vectors of the channels' poses
  std::shared_ptr<const shapes::ShapeSpace> shapes_;  // null if no key has a shape
  std::vector<std::shared_ptr<const shapes::LogVector>> shape_vectors_;
  std::vector<shapes::AnchorWeights> shape_anchors_;
  std::vector<std::string> notes_;
};

}  // namespace viete::document
