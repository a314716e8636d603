// The deformed model at the frames of a timeline as files: the same from the window and from the command
// line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/numbered_files.h"
#include "base/progress.h"
#include "scene/document/timeline.h"
#include "scene/files/export.h"
#include "scene/files/output.h"

namespace viete::scene {

/// All that the files are made of, as it is at one moment, see Export. Its file says what they are:
///
/// .pc2, .mdd      a point cache of all frames; vertices in the model's order
/// .glb, .gltf     one model with morph targets and an animation that plays them: a target for each key, and
///                 between keys one wherever straight lines would lead too far off; not where the name has a
///                 place for the number
/// NAME_####.obj   (.ply, .off, .stl, .glb, .gltf) one model a frame, see base::NumberedName; the same bits
/// as
///                 write_deformed() gives for the frame's pose
struct AnimationExport {
  Export model;                       ///< its pose is not looked at
  Timeline timeline;                  ///< keys, and whether they go straight
  int first = 1, last = 1, step = 1;  ///< frames; last >= first, step >= 1
  double rate = 24;                   ///< frames a second
  double tolerance = 1e-4;  ///< of morph targets: how far from any of these frames lines between them may
                            ///< lead, in diagonals of the model; above 0
  bool normals = true;      ///< of morph targets: without, they take half as much, and light stays as at rest
  double most_bytes = 1e9;  ///< of morph targets and their weights; more is refused
  std::string to_allow_more{};  ///< advice for that: "allow more megabytes (--largest)"; empty: none
  Force force = Force::none;    ///< replace numbered files that are there

  std::vector<int> frames() const;
};

/// Of the timeline's range and rate. Requires that something moves the model.
AnimationExport animation_export_of(const Document& document, const std::filesystem::path& file);

struct AnimationReport {
  std::size_t frames = 0;            ///< that are in the files now, or poses of morph targets
  std::string summary{};             ///< one line: what was written, by which engine, and how exact it is
  std::vector<std::string> notes{};  ///< what a person should know of the result, one line each
};

/// The extensions of one file for all frames: "pc2", "glb" ...
bool is_animation_format(const std::string& extension);

/// Throws base::Error where the name says nothing that can be written, or cannot be written, or the timeline
/// has no keys.
void check_animation_export(const AnimationExport& what);

/// Writes it, with one binding for all frames. Every file is there as a whole or as it was, whenever the
/// program ends. Uses a pool of its own for as long as it takes. progress may be null. Throws base::Error,
/// also where a numbered file is there and `force` is not given, and base::Cancelled. Thread-safe.
///
/// Numbered files are in double. Point caches hold floats: they take the engine of the window, with weights
/// as they are, where that is off by no more than fast_frame_error at three frames, and double otherwise; so
/// do morph targets. The summary says which, and how far off.
AnimationReport write_animation(const AnimationExport& what, base::Progress* progress = nullptr);

/// What morph targets would take beside the model, by some of its vertices.
struct MorphEstimate {
  std::size_t targets = 0;
  double bytes = 0;
};
/// Writes nothing. Requires keys. Throws what write_animation() does. Thread-safe.
MorphEstimate estimate_morphs(const AnimationExport& what, base::Progress* progress = nullptr);

/// Diagonals of the cage.
inline constexpr double fast_frame_error = 2e-6;

/// Tells of files of the sequence of none of these frames, such as an earlier run's with more frames: a
/// line, or nothing. Throws base::Error.
std::vector<std::string> other_files_note(const base::NumberedName& name, std::span<const int> frames);

}  // namespace viete::scene
