// Edits of the named poses and of their mix. Each is undoable.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "document/animation.h"
#include "document/document.h"

namespace viete::document {

/// The complete current pose, with Document::kept_pose while the cage itself is edited.
WholePose whole_pose(const Document& document);
SharedPose shared_pose(const Document& document);
/// Sets the complete pose; not an edit. Locked probes stay. Whole poses from elsewhere (timeline, file) end
/// the mix: see end_mix().
void put_whole_pose(Document& document, const WholePose& pose);
/// Moves all pins to their vertices in the shape. Not an edit.
void move_pins_to_shape(Document& document);
/// Sets all weights to 0 and keeps the current pose as unmixed. Not an edit.
void end_mix(Document& document);

/// The pose without the mix; null if nothing is mixed, or the pose has been edited since.
SharedPose unmixed_pose(const Document& document);

/// The requested name, with a number appended if another pose has it. Cut to PoseLibrary::longest_name.
std::string free_name(const PoseLibrary& library, const std::string& wish);

/// Appends the current pose to the list and returns its index. Throws base::Error beyond
/// PoseLibrary::most_poses.
std::size_t keep_pose(Document& document, const std::string& name);
/// Appends loaded poses; one edit. Throws like keep_pose().
void add_poses(Document& document, std::vector<NamedPose> poses);
/// Appends shapes of the model, with the cage at rest. One edit; throws like keep_pose().
void add_shapes(Document& document, std::vector<NamedShape> shapes);
/// Replaces a named pose by the current pose.
void update_pose(Document& document, std::size_t pose);
/// Makes a named pose the current pose; ends the mix.
void apply_pose(Document& document, std::size_t pose);
void rename_pose(Document& document, std::size_t pose, const std::string& name);
/// Moves a pose before the pose `to`, or to the end.
void move_pose(Document& document, std::size_t pose, std::size_t to);
/// Removes a pose, and its contribution to the mix.
void remove_pose(Document& document, VectorCache& vectors, std::size_t pose);

/// Sets a pose's weight in the mix, PoseLibrary::least_weight to largest_weight. Consecutive changes of the
/// same pose are one edit. Returns false, without a change, if the mix would exceed the drawable range, see
/// in_range(). `played`: the current weights of all poses if the pose comes from keys; the mix continues from
/// these.
bool set_weight(Document& document, VectorCache& vectors, std::size_t pose, double weight,
                std::span<const double> played = {});
/// Sets all weights to 0. Returns false like set_weight().
bool clear_mix(Document& document, VectorCache& vectors);
/// Blends poses, here and between keys, linearly (`straight`) or in log space. One edit.
bool set_straight(Document& document, VectorCache& vectors, bool straight);
/// The mix recomputed linearly or in log space; null if the pose is not a mix or would exceed the drawable
/// range.
SharedPose mixed_by(const Document& document, VectorCache& vectors, bool straight);

/// After a change of the cage or of the number of probes: updates all poses, including those of keys. Part of
/// the edit in progress.
void carry_poses(Document& document, const std::function<deform::Pose(const deform::Pose&)>& carried);
/// The cage becomes `by`: poses with shapes keep them, with that cage at rest; all others are removed.
/// Returns the removed ones as "3 poses and 2 keys"; empty: none.
std::string drop_poses(Document& document, const deform::Cage& by);
/// Copies the shapes of another document's poses to `to`, a document of the same model with its cage at rest.
/// Returns the dropped poses as drop_poses() does.
std::string keep_shapes(Document& to, const Document& from);
void forget_probe(Document& document, std::size_t probe);

/// Sets the pose as an undoable edit. Requires one position per cage vertex.
void set_pose(Document& document, deform::Pose pose);

}  // namespace viete::document
