// Exports the model deformed at the frames of a timeline, for the window and the command line.
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

/// A snapshot of the exported data, see Export. The file name selects the format:
///
/// .pc2, .mdd      a point cache of all frames; vertices in the model's order
/// .glb, .gltf     one model with animated morph targets: a target for each key, and further ones
///                 between keys where linear blending exceeds the tolerance; the name must have no
///                 place for a number
/// NAME_####.obj   (.ply, .off, .stl, .glb, .gltf) one model per frame, see base::NumberedName; equal to
///                 write_deformed() of the frame's pose, bit for bit
struct AnimationExport {
  Export model;                       ///< its pose is ignored
  document::Timeline timeline;        ///< keys, and whether blending is linear
  int first = 1, last = 1, step = 1;  ///< frames; last >= first, step >= 1
  double rate = 24;                   ///< frames a second
  double tolerance = 1e-4;  ///< morph targets: maximum error of linear blending at these frames, in diagonals
                            ///< of the model; above 0
  bool normals = true;      ///< morph targets: with normals; twice as large, else shading stays as at rest
  double most_bytes = 1e9;  ///< morph targets: limit of their size with weights; beyond it throws
  Force force = Force::none;  ///< replace existing numbered files

  std::vector<int> frames() const;
};

/// With the timeline's range and rate. Requires that something moves the model.
AnimationExport animation_export_of(const document::Document& document, const std::filesystem::path& file);

struct AnimationReport {
  std::size_t frames = 0;            ///< written frames, or poses of morph targets
  std::string summary{};             ///< one line: the files, the engine and its accuracy
  std::vector<std::string> notes{};  ///< messages about the result for the user, one line each
};

/// The formats that store all frames in one file: "pc2", "glb" ...
bool is_animation_format(const std::string& extension);

/// Throws base::Error if the format is unknown, the file cannot be written, or the timeline has no keys.
void check_animation_export(const AnimationExport& what);

/// Writes all frames with a single binding. Each file is either complete or unchanged, whenever the program
/// ends. Creates its own thread pool. progress may be null. Throws base::Error, also if a numbered file
/// exists and `force` is not given, and base::Cancelled. Thread-safe.
///
/// Numbered files use double precision. Point caches and morph targets store floats: they use the window's
/// engine, with unchanged weights, if its error at three frames is at most fast_frame_error, and double
/// precision otherwise. The summary names the engine and its error.
AnimationReport write_animation(const AnimationExport& what, base::Progress* progress = nullptr);

/// Diagonals of the cage.
inline constexpr double fast_frame_error = 2e-6;

/// A note if files of the sequence exist for other frames, such as those of a longer earlier export;
/// otherwise empty. Throws base::Error.
std::vector<std::string> other_files_note(const base::NumberedName& name, std::span<const int> frames);

}  // namespace viete::files
