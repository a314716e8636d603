// Edits of the poses with names, and of what is mixed of them. Each is undoable.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scene/document/animation.h"
#include "scene/document/document.h"

namespace viete::scene {

/// What moves the model now; the real pose while the cage itself is edited.
WholePose whole_pose(const Document& document);
SharedPose shared_pose(const Document& document);
/// Puts it there, in whole. No edit. Locked probes stay. Whole poses of other places (time, a file) end the
/// mix: see end_mix().
void put_whole_pose(Document& document, const WholePose& pose);
/// All pins are where the shape has their vertices. No edit.
void take_pins_along(Document& document);
/// All weights become 0: what is there counts as made by hand. No edit.
void end_mix(Document& document);

/// What is there without the mix, as it was before; null where nothing is mixed, or a hand has changed it
/// since.
SharedPose unmixed_pose(const Document& document);

/// A name that no other pose has: the same, or with a number behind it. Cut to PoseLibrary::longest_name.
std::string free_name(const PoseLibrary& library, const std::string& wish);

/// The pose that is there, behind the others. Returns its number. Throws base::Error beyond
/// PoseLibrary::most_poses.
std::size_t keep_pose(Document& document, const std::string& name);
/// Those that were read, behind the others; one edit. Throws likewise.
void add_poses(Document& document, std::vector<NamedPose> poses);
/// Likewise shapes of the model, with the cage at rest.
void add_shapes(Document& document, std::vector<NamedShape> shapes);
/// That pose becomes what is there.
void update_pose(Document& document, std::size_t pose);
/// It becomes what is there; the mix ends.
void apply_pose(Document& document, std::size_t pose);
void rename_pose(Document& document, std::size_t pose, const std::string& name);
/// To before the pose `to`, or to the end.
void move_pose(Document& document, std::size_t pose, std::size_t to);
void duplicate_pose(Document& document, std::size_t pose);
/// What it has mixed in goes with it.
void remove_pose(Document& document, KnownVectors& vectors, std::size_t pose);

/// Mixes in so much of it, PoseLibrary::least_weight to largest_weight. One that was at 0 moves the whole
/// cage; or, if `selected_alone`, the part of it that is selected, if any of its vertices is. Until it is at
/// 0 again it moves the same. Weights of the same pose that are chosen one after the other are one edit. Says
/// whether it did: not where the mix would leave what can be drawn, see in_range(); then nothing has changed.
/// `played` are the weights of all poses where keys have made what is there: the mix goes on from these.
bool set_weight(Document& document, KnownVectors& vectors, std::size_t pose, double weight,
                bool selected_alone = false, std::span<const double> played = {});
/// Vertices of the cage that are moved then; none: all.
std::vector<std::uint32_t> selected_part(const Document& document);
/// All become 0. Likewise.
bool clear_mix(Document& document, KnownVectors& vectors);
/// Weights are divided by their sum: an average of poses. Likewise; not where the sum is 0 or less, or so
/// small that weights would leave their range.
bool average_mix(Document& document, KnownVectors& vectors);

/// Poses are added in straight lines, here and between keys, or in log space. One edit.
bool set_straight(Document& document, KnownVectors& vectors, bool straight);
/// What the mix would be if it was straight, or was not; null where the pose is no mix, or none that can be
/// drawn.
SharedPose mixed_by(const Document& document, KnownVectors& vectors, bool straight);

/// Another cage, or another number of probes: all poses, those of keys too, go with it. Part of the edit that
/// is being made.
void carry_poses(Document& document, const std::function<deform::Pose(const deform::Pose&)>& carried);
/// "3 poses and 2 keys"; empty if there are none.
std::string counted_poses(std::size_t poses, std::size_t keys);
/// They are of another cage than `by`: those that have shapes keep them, with that cage at rest, and all
/// others are gone: "3 poses and 2 keys"; empty if there were none.
std::string drop_poses(Document& document, const deform::Cage& by);
/// What `to`, a document of the same model with its cage at rest, keeps of another's poses: their shapes.
/// Returns what it does not keep, likewise.
std::string keep_shapes(Document& to, const Document& from);
void forget_probe(Document& document, std::size_t probe);

/// Another pose as an edit: undoable. Requires one position per cage vertex.
void set_pose(Document& document, deform::Pose pose);

}  // namespace viete::scene
