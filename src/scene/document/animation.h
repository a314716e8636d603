// What moves at any moment of a timeline: keys blended in log space.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "deform/pose_space.h"
#include "deform/shape_space.h"
#include "scene/document/document_state.h"
#include "scene/document/timeline.h"

namespace viete::scene {

/// Poses of one cage, and shapes of one model, as vectors, each taken once. Not thread-safe.
class KnownVectors {
public:
  /// Of another cage, or none (null), all are forgotten.
  void follow(const std::shared_ptr<const deform::Cage>& cage);
  /// Likewise of another model and its shapes.
  void follow_model(const std::shared_ptr<const mesh::Surface>& model);
  /// Null where there is no cage.
  const std::shared_ptr<const deform::PoseSpace>& space() const { return space_; }
  /// See PoseSpace::vector(). Null where there is no cage. Kept as long as the pose is in use elsewhere.
  std::shared_ptr<const deform::LogVector> of(const SharedPose& pose,
                                              std::span<const mesh::Vec3> turns_before = {});

  /// Made when it is asked for. Requires a model. Throws base::Error: see ShapeSpace.
  const std::shared_ptr<const deform::ShapeSpace>& shapes(base::WorkerPool& pool);
  /// Branches continue those of the shape before; null: at rest. Kept as long as the shape is in use
  /// elsewhere. Throws base::Error: see ShapeSpace::vector().
  std::shared_ptr<const deform::LogVector> of(const SharedShape& shape,
                                              const std::shared_ptr<const deform::LogVector>& before,
                                              base::WorkerPool& pool, deform::ShapeReport& report);
  /// What others know of shapes of the same model is known from now on.
  void take(KnownVectors&& others);

private:
  struct Known {
    SharedPose pose;
    std::vector<mesh::Vec3> turns_before;
    std::shared_ptr<const deform::LogVector> vector;
  };
  std::shared_ptr<const deform::Cage> cage_;
  std::shared_ptr<const deform::PoseSpace> space_;
  std::map<const WholePose*, Known> known_;

  struct Told {
    std::shared_ptr<const deform::LogVector> before, vector;
    deform::ShapeReport report;
  };
  struct KnownShape {
    SharedShape shape;
    std::vector<Told> told;  // a shape may come after several others
  };
  std::shared_ptr<const mesh::Surface> model_;
  std::shared_ptr<const deform::ShapeSpace> shapes_;
  std::map<const void*, KnownShape> known_shapes_;
};

/// The poses of a timeline at any frame. Constant: thread-safe, and the same bits whatever frame came before.
/// At a key's frame it is that key's pose, bit for bit. A pose that says nothing of whole turns has those
/// nearest to the key before.
///
/// What is shown between keys is the cage that follows the blended logs, see PoseSpace; a timeline that is
/// straight moves its vertices on straight lines. Probes are blended by their logs in either case. Where that
/// leaves what can be drawn, as `smooth` may where it overshoots, the key before stays.
class Animation {
public:
  /// Requires keys, of this cage; where keys have shapes, of this model. Throws base::Error where a shape is
  /// none of it.
  Animation(const Timeline& timeline, KnownVectors& vectors);

  /// What a person should know of the keys' shapes, one line each.
  const std::vector<std::string>& notes() const { return notes_; }

  WholePose at(double frame) const;
  /// As if the timeline was straight, or was not.
  WholePose at(double frame, bool straight) const;

private:
  WholePose key(std::size_t key) const;
  std::vector<double> place(std::size_t key, bool logs) const;
  WholePose blend(const Moment& moment, bool straight) const;
  SharedShape blended_shape(const Moment& moment, bool straight) const;
  void add_shapes(KnownVectors& vectors);
  void take_farthest(std::span<const mesh::Point> positions);

  Timeline timeline_;
  double farthest_ = most_drawn;  // coordinate; or that of a key, of models that are deformed and not drawn
  std::shared_ptr<const deform::PoseSpace> space_;
  std::vector<std::shared_ptr<const deform::LogVector>> vectors_;  // of the keys; null without a cage
  std::vector<deform::Held> held_;                                 // from each key to the next

  std::shared_ptr<const deform::ShapeSpace> shapes_;  // null: no key has a shape
  std::vector<std::shared_ptr<const deform::LogVector>> shape_vectors_;
  std::vector<deform::Held> held_shapes_;
  std::vector<std::string> notes_;
};

}  // namespace viete::scene
