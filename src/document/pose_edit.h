// Edits of the named poses and of the mix. All edits are undoable.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "document/animation.h"
#include "document/document.h"

namespace viete::document {

/// Returns the current pose of shape, cage and probes. During cage editing, uses kept_pose() for the cage.
WholePose whole_pose(const Document& document);
SharedPose shared_pose(const Document& document);

// The next three functions do not record an edit.

/// Shows a pose: sets shape, cage and unlocked probes. Ends cage editing, and moves the pins to their
/// vertices. `kind` is the source of the pose. If it is not a mix, sets all weights to 0. `base`: see
/// PoseSource.
void show_pose(Document& document, const WholePose& pose, PoseSource::Kind kind, SharedPose base = nullptr);
/// True if the document has this pose. Ignores pins and locked probes.
bool shows(const Document& document, const WholePose& pose);
/// Returns the source of the shown pose: `edited` if the pose was edited after the source had computed it.
PoseSource::Kind source_of(const Document& document);
/// Moves each pin to the position of its vertex in the shape.
void move_pins_to_shape(Document& document);
/// Sets all weights to 0 and keeps the current pose.
void end_mix(Document& document);

/// Returns the pose without the mix. If all weights are 0, or the pose was edited after mixing, returns null.
SharedPose unmixed_pose(const Document& document);

/// Returns the current pose without the poses of the library `weighted`, which has other weights than the
/// document's library.
SharedPose pose_without(const Document& document, VectorCache& vectors, PoseLibrary weighted);
/// After a change of the named poses: puts them into their channels, and removes channels of removed poses.
void follow_library(const PoseLibrary& library, Timeline& timeline);

/// Returns the requested name, cut to PoseLibrary::longest_name. If a pose has this name, adds a number.
std::string free_name(const PoseLibrary& library, const std::string& wish);

/// Returns the poses with nonzero weights.
std::vector<MixedPose> mixed_poses(const PoseLibrary& library);

/// Adds the current pose, without the weighted poses, to the list with weight 1, and returns its index. The
/// current pose and the other weights do not change. set_weight() explains `played`. If the list is full or
/// the added pose is out of the drawable range, throws base::Error.
std::size_t keep_pose(Document& document, VectorCache& vectors, const std::string& name,
                      std::span<const double> played = {});
/// Adds poses to the list. Throws errors of keep_pose().
void add_poses(Document& document, std::vector<NamedPose> poses);
/// Adds poses with these shapes to the list. Their cage is at rest. Throws errors of keep_pose().
void add_shapes(Document& document, std::vector<NamedShape> shapes);
/// Replaces a named pose by the current pose. Sets its weight to 1 and the other weights to 0, and removes
/// the pose from keys' mixes.
void update_pose(Document& document, std::size_t pose);
/// Makes a named pose the current pose. Sets its weight to 1 and the other weights to 0.
void apply_pose(Document& document, std::size_t pose);
void rename_pose(Document& document, std::size_t pose, const std::string& name);
/// Moves a pose to the place before pose `to`. If `to` is the number of poses, moves the pose to the end.
void move_pose(Document& document, std::size_t pose, std::size_t to);
/// Removes a pose from the list and from all mixes. If the new mix is out of range, sets all weights to 0.
void remove_pose(Document& document, VectorCache& vectors, std::size_t pose);

/// Sets a pose's weight in the mix, clamped to the range in PoseLibrary. Consecutive changes for one pose
/// at one frame form one edit. If the mix would be out of the drawable range (see in_range()), changes
/// nothing and returns false. If the current pose comes from keys, `played` has the weights of all named
/// poses in this pose. Otherwise `played` is empty.
bool set_weight(Document& document, VectorCache& vectors, std::size_t pose, double weight,
                std::span<const double> played = {});
/// Sets all weights to 0. Otherwise like set_weight().
bool clear_mix(Document& document, VectorCache& vectors, std::span<const double> played = {});
/// Sets how poses and keys are blended: linearly or in log space. Can return false like set_weight().
bool set_linear(Document& document, VectorCache& vectors, bool linear);
/// Returns the mix, computed linearly if `linear`, otherwise in log space. If the current pose is not a
/// mix, or the result is out of the drawable range, returns null.
SharedPose mixed_by(const Document& document, VectorCache& vectors, bool linear);

// The next four functions do not record an edit.

/// After a cage edit: ends the mix. In named poses and keys, replaces each cage pose p by carried(p).
void carry_poses(Document& document, const std::function<pose::Pose(const pose::Pose&)>& carried);
/// Ends the mix. Adapts named poses and keys to the new cage `by`: removes poses without a shape; in other
/// poses, puts the cage at rest. Returns the number of removed poses, such as "3 poses and 2 keys", or "".
std::string drop_poses(Document& document, const pose::Cage& by);
/// Copies shape, named poses and keys to another document of an equal model, and calls drop_poses() on it.
std::string keep_shapes(Document& to, const Document& from);
/// Removes a probe from all named poses and keys.
void forget_probe(Document& document, std::size_t probe);

/// Sets the cage's pose (one position per vertex) as an undoable edit. Ends the mix and cage editing.
void set_pose(Document& document, pose::Pose pose);

}  // namespace viete::document
