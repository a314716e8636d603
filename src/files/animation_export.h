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
/// .glb, .gltf     one model with animated morph targets: a target for each key, and more targets between
///                 keys if linear blending exceeds the tolerance
/// NAME_####.obj   (also .ply, .off, .stl, .glb, .gltf) one model per frame, see base::NumberedName; each
///                 file is identical to the result of write_deformed()
struct AnimationExport {
  Export model;                       ///< the pose is ignored
  document::Timeline timeline;        ///< keys, and whether blending is linear
  int first = 1, last = 1, step = 1;  ///< frames; last >= first, step >= 1
  double rate = 24;                   ///< frames per second
  double tolerance = 1e-4;    ///< morph targets: maximum error at these frames in model diagonals, > 0
  bool normals = true;        ///< morph targets: also animate normals, which doubles the size
  double most_bytes = 1e9;    ///< morph targets: maximum size including weights
  Force force = Force::none;  ///< Force::given replaces existing numbered files

  std::vector<int> frames() const;
};

/// Uses the range and rate of the timeline. document.is_movable() must be true.
AnimationExport animation_export_of(const document::Document& document, const std::filesystem::path& file);

struct AnimationReport {
  std::size_t frames = 0;            ///< number of written frames; for morph targets, number of keys
  std::string summary{};             ///< one line: the number of frames or targets, and the accuracy
  std::vector<std::string> notes{};  ///< messages about the result for the user, one line each
};

/// Returns true if the format of the extension stores all frames in one file: "pc2", "glb" ...
bool is_animation_format(const std::string& extension);

/// Throws base::Error if the format is unsuitable, the file is not writable, or the timeline has no keys.
void check_animation_export(const AnimationExport& what);

/// Writes all frames. Writes each file atomically. Creates a thread pool. progress may be null. If a numbered
/// file exists and `force` is not given, throws base::Error. Also throws base::Cancelled. Thread-safe.
///
/// Numbered files use double precision. Point caches and morph targets use AnimatedModel::Precision::fast if
/// this precision has an error of at most fast_frame_error at three frames, otherwise double.
AnimationReport write_animation(const AnimationExport& what, base::Progress* progress = nullptr);

inline constexpr double fast_frame_error = 2e-6;  ///< in diagonals of the cage

/// Returns a message if files of the sequence exist for other frames, for example from a longer earlier
/// export. Otherwise returns an empty list. Throws base::Error.
std::vector<std::string> other_files_note(const base::NumberedName& name, std::span<const int> frames);

}  // namespace viete::files
