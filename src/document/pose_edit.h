// Edits of the named poses and of their mix. Edits are undoable.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "document/animation.h"
#include "document/document.h"

namespace viete::document {

/// Return the current pose of shape, cage and probes. During cage editing, the cage's pose is kept_pose.
WholePose whole_pose(const Document& document);
SharedPose shared_pose(const Document& document);

// The next three functions record no edit.

/// Sets the pose of shape, cage and unlocked probes. Call end_mix() if the pose is not the mix.
void put_whole_pose(Document& document, const WholePose& pose);
/// Moves all pins to their vertices in the shape.
void move_pins_to_shape(Document& document);
/// Sets all weights to 0 and keeps the current pose.
void end_mix(Document& document);

/// Returns the pose without the mix; null if all weights are 0 or the pose was edited after mixing.
SharedPose unmixed_pose(const Document& document);

/// Returns the requested name, cut to PoseLibrary::longest_name. Adds a number if a pose has this name.
std::string free_name(const PoseLibrary& library, const std::string& wish);

/// Adds the current pose to the list and returns its index. Throws base::Error if the list is full.
std::size_t keep_pose(Document& document, const std::string& name);
/// Adds poses to the list. Throws like keep_pose().
void add_poses(Document& document, std::vector<NamedPose> poses);
/// Adds shapes of the model to the list, with the cage at rest. Throws like keep_pose().
void add_shapes(Document& document, std::vector<NamedShape> shapes);
/// Replaces a named pose by the current pose.
void update_pose(Document& document, std::size_t pose);
/// Makes a named pose the current pose, and ends the mix.
void apply_pose(Document& document, std::size_t pose);
void rename_pose(Document& document, std::size_t pose, const std::string& name);
/// Moves a pose before the pose with index `to`. If `to` is the number of poses, moves the pose to the end.
void move_pose(Document& document, std::size_t pose, std::size_t to);
/// Removes a pose from the list and from the mix.
void remove_pose(Document& document, VectorCache& vectors, std::size_t pose);

/// Sets a pose's weight in the mix, clamped to PoseLibrary::least_weight and largest_weight. Consecutive
/// changes for one pose are one edit. Returns false and changes nothing if the mix would leave the drawable
/// range (see in_range()). `played` has the weights of all poses, if the current pose comes from keys.
bool set_weight(Document& document, VectorCache& vectors, std::size_t pose, double weight,
                std::span<const double> played = {});
/// Sets all weights to 0. Returns false like set_weight().
bool clear_mix(Document& document, VectorCache& vectors);
/// Chooses how poses and keys are blended: linearly or in log space. Returns false like set_weight().
bool set_straight(Document& document, VectorCache& vectors, bool straight);
/// Returns the mix, computed linearly or in log space. Returns null if the current pose is not a mix, or if
/// the result would leave the drawable range.
SharedPose mixed_by(const Document& document, VectorCache& vectors, bool straight);

// The next four functions record no edit.

/// Replaces the cage's pose in all named poses and keys by carried(pose). Call this after editing the cage.
void carry_poses(Document& document, const std::function<deform::Pose(const deform::Pose&)>& carried);
/// Adapts the poses to a new cage: removes all poses without a shape, and puts the cage of the others at
/// rest. Returns text such as "3 poses and 2 keys" for the removed poses; empty if no pose was removed.
std::string drop_poses(Document& document, const deform::Cage& by);
/// Copies shape, named poses and keys to another document of the same model, then calls drop_poses() on it.
std::string keep_shapes(Document& to, const Document& from);
/// Removes a probe from all named poses and keys.
void forget_probe(Document& document, std::size_t probe);

/// Sets the cage's pose as an undoable edit. Requires one position per cage vertex.
void set_pose(Document& document, deform::Pose pose);

}  // namespace viete::document
