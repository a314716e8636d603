// Exports the deformed model at the frames of a timeline.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/numbered_files.h"
#include "base/progress.h"
#include "document/timeline.h"
#include "files/export.h"
#include "files/output.h"

namespace viete::files {

/// A copy of the data to export, see Export. The file name selects the format:
///
/// .pc2, .mdd      a point cache of all frames, with the vertices in the model's order
/// .glb, .gltf     one model with animated morph targets: a target for each key. Between two keys, further
///                 targets are added until linear blending is within the tolerance. If the weights of
///                 shapes have keys, the interpolation is linear and there is neither a cage nor a probe,
///                 each keyed shape is a target with its weight at each frame.
/// NAME_####.obj   (also .ply, .off, .stl, .glb, .gltf) one model per frame, see base::NumberedName. Each
///                 file is identical to the result of write_deformed().
struct AnimationExport {
  Export model;                       ///< model.pose is ignored
  document::Timeline timeline;        ///< keys, and the kind of blending
  int first = 1, last = 1, step = 1;  ///< frames; last >= first, step >= 1
  double rate = 24;                   ///< frames per second
  double tolerance = 1e-4;            ///< morph targets: maximum error / diagonal of the model, > 0
  bool normals = true;                ///< morph targets: also animates the normals, and doubles the size
  double most_bytes = 1e9;            ///< morph targets: maximum size of targets and weights
  Force force = Force::none;          ///< Force::given replaces existing numbered files

  std::vector<int> frames() const;
};

/// Takes the range and the rate from the document's timeline. document.is_movable() must be true.
AnimationExport animation_export_of(const document::Document& document, const std::filesystem::path& file);

struct AnimationReport {
  std::size_t frames = 0;            ///< number of written frames; for morph targets, keys in the file
  std::string summary{};             ///< one line: the number of frames or targets, and the accuracy
  std::vector<std::string> notes{};  ///< messages about the result for the user, one line each
};

/// Returns true if the format of the extension stores all frames in one file: "pc2", "glb" ...
bool is_animation_format(const std::string& extension);

/// Throws base::Error if the format is unsuitable, the file is not writable, or the timeline has no keys.
void check_animation_export(const AnimationExport& what);

/// Writes all frames, each file atomically. Creates a thread pool. progress may be null. Throws base::Error
/// and base::Cancelled. Without Force::given, an existing numbered file is an error. Thread-safe.
///
/// Numbered files are computed in double precision. Point caches and morph targets are computed in float if
/// the error at three frames is at most fast_frame_error; otherwise also in double precision.
AnimationReport write_animation(const AnimationExport& what, base::Progress* progress = nullptr);

inline constexpr double fast_frame_error = 2e-6;  ///< maximum error of float / diagonal of the cage

/// If files of the sequence exist for frames outside `frames`, returns one message, otherwise an empty list.
/// Such files can remain from an earlier, longer export. `frames` must be sorted. Throws base::Error.
std::vector<std::string> other_files_note(const base::NumberedName& name, std::span<const int> frames);

}  // namespace viete::files
