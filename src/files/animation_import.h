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

/// Reads posed cages. Each file gives a pose with the file's name and, if the file has them, full turns. A
/// glTF file with morph targets gives a pose for each target. A folder gives the poses of its models in
/// natural order, and a warning for each model that does not match the cage. If a named file does not match
/// the cage, or there are no poses or too many, throws base::Error. Thread-safe.
ImportedPoses read_poses(std::span<const std::filesystem::path> files, const deform::Cage& cage,
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
/// numbered posed cages   `pose_####.obj`, or one file of the sequence: a key per file at the frame with
///                        this number; smooth interpolation
/// .pc2                   a key per sample, at the frames in the file; linear interpolation
/// .mdd                   a key per frame, at the times in the file; linear interpolation
/// .glb, .gltf            the cage with animated morph targets: a key for each key of the file, at its time;
///                        linear interpolation
///
/// Only posed cages store full turns. Other keys get the turns nearest to the previous key. If several keys
/// have the same frame, uses the first and adds a warning. If the number of vertices differs, a frame is out
/// of range, or there are no frames or too many, throws base::Error. Thread-safe.
ImportedKeys read_keys(const std::filesystem::path& file, const deform::Cage& cage, const ImportTimes& times,
                       base::Progress* progress = nullptr);

/// Replaces the keys and the range of the timeline, as one edit. Camera keys stay.
void put_keys(document::Document& document, std::vector<document::PoseKey> keys, const std::string& label);

}  // namespace viete::files
