// Imports named poses and timeline keys from files of other programs.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "document/document.h"
#include "document/document_state.h"
#include "document/timeline.h"

namespace viete::files {

struct ImportedPoses {
  std::vector<document::NamedPose> poses;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;  ///< the files read
};

/// Reads posed cages. Each file gives a pose with the name of the file and its full turns, if stored; a glTF
/// file with morph targets gives a pose per target. A folder gives the poses of its models in natural order,
/// and a warning for each model that does not fit the cage. Throws base::Error if a named file does not fit
/// the cage, or if there are no poses or too many. Thread-safe.
ImportedPoses read_poses(std::span<const std::filesystem::path> files, const deform::Cage& cage,
                         base::Progress* progress = nullptr);

struct ImportedKeys {
  std::vector<document::PoseKey> keys;  ///< sorted by frame
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;  ///< the files read
};

/// Converts seconds to frames: frame = first + rate * seconds.
struct ImportTimes {
  int first = 1;
  double rate = 24;
};

/// Reads keys of the cage. Possible files:
///
/// numbered posed cages   `pose_####.obj`, or one file of the sequence: a key per file at the frame with
///                        this number; smooth interpolation
/// .pc2                   a key per sample, at the frames in the file; linear interpolation
/// .mdd                   a key per frame, at the times in the file; linear interpolation
/// .glb, .gltf            the cage with animated morph targets: a key for each key of the file, at its time;
///                        linear interpolation
///
/// Only posed cages store full turns; other keys get the turns nearest to the previous key. If several keys
/// have the same frame, the first is used and a warning is added. Throws base::Error if the number of
/// vertices differs, a frame is out of range, or there are no frames or too many. Thread-safe.
ImportedKeys read_keys(const std::filesystem::path& file, const deform::Cage& cage, const ImportTimes& times,
                       base::Progress* progress = nullptr);

/// Replaces the keys and the range of the timeline as an edit. Camera keys stay.
void put_keys(document::Document& document, std::vector<document::PoseKey> keys, const std::string& label);

}  // namespace viete::files
