// Named poses and timeline keys from files of other programs.
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

/// Posed cages, each a pose named after its file, with its turns if stored; a glTF file with morph targets
/// gives one pose per target. A folder stands for its models in natural order; models that do not fit the
/// cage are skipped with a warning. Throws base::Error if a named file does not fit, if there is no pose, or
/// if there are more than a document holds. Thread-safe.
ImportedPoses read_poses(std::span<const std::filesystem::path> files, const deform::Cage& cage,
                         base::Progress* progress = nullptr);

struct ImportedKeys {
  std::vector<document::PoseKey> keys;  ///< sorted by frame
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;  ///< the files read
};

/// Conversion of seconds to frames: time 0 of the file is frame `first`.
struct ImportTimes {
  int first = 1;
  double rate = 24;
};

/// Keys of the cage from
///
/// numbered posed cages   (`pose_####.obj`, or one file of the sequence): the number is the frame; smooth
/// .pc2                   of the cage's vertices: a key per sample, at the frames in the file; linear
/// .mdd                   likewise, at the times in the file; linear
/// .glb, .gltf            the cage with animated morph targets: one key for each of theirs, at its
///                        time; linear
///
/// Only posed cages store whole turns: other keys take those nearest to the previous key. If several keys
/// fall on one frame the first is used, with a warning. Throws base::Error: vertex counts differ, no frames,
/// more than a timeline holds, frames out of range. Thread-safe.
ImportedKeys read_keys(const std::filesystem::path& file, const deform::Cage& cage, const ImportTimes& times,
                       base::Progress* progress = nullptr);

/// Replaces the existing keys and the range, as an edit. Camera keys stay.
void put_keys(document::Document& document, std::vector<document::PoseKey> keys, const std::string& label);

}  // namespace viete::files
