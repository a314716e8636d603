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
  std::vector<std::filesystem::path> files;  ///< the files that were read
};

/// Reads posed cages. Each file gives one pose with the name of the file. A glTF file with morph targets
/// gives one pose for each target. A folder gives the poses of its models in natural order. In a folder, a
/// model that does not match the cage gives a warning. Throws base::Error in these cases: a file in `files`
/// does not match the cage, a folder has no pose of the cage, or there are too many poses. Thread-safe.
ImportedPoses read_poses(std::span<const std::filesystem::path> files, const pose::Cage& cage,
                         base::Progress* progress = nullptr);

struct ImportedKeys {
  std::vector<document::PoseKey> keys;  ///< sorted by frame
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;  ///< the files that were read
};

/// Converts seconds to frames: frame = first + rate * seconds.
struct ImportTimes {
  int first = 1;
  double rate = 24;
};

/// Reads keys of the cage from these files:
///
/// numbered posed cages   `pose_####.obj`, or one file of this sequence. Each file gives a key; the number
///                        in the file name is the frame. Smooth interpolation.
/// .pc2                   Each sample gives a key, at its frame in the file. Linear interpolation.
/// .mdd                   Each frame gives a key, at its time in the file. Linear interpolation.
/// .glb, .gltf            the cage with animated morph targets. Each key of the file gives a key at the same
///                        time. Linear interpolation; STEP holds; CUBICSPLINE gives a key at each frame.
///
/// Only numbered posed cages store whole turns. In keys from other files, each rotation gets the number of
/// whole turns that brings it nearest to the rotation in the previous key. If several keys have the same
/// frame, uses the first key and adds a warning. Throws base::Error in these cases: the number of vertices
/// differs, a frame is out of range, or the number of frames is 0 or too large. Thread-safe.
ImportedKeys read_keys(const std::filesystem::path& file, const pose::Cage& cage, const ImportTimes& times,
                       base::Progress* progress = nullptr);

/// Replaces the pose keys of the timeline, and sets the playback range to the frames of `keys`, as one edit.
/// Camera keys stay. `keys` must not be empty.
void put_keys(document::Document& document, std::vector<document::PoseKey> keys, const std::string& label);

}  // namespace viete::files
