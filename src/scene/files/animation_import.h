// Poses with names, and keys in time, from files of other programs.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "scene/document/document.h"
#include "scene/document/document_state.h"
#include "scene/document/timeline.h"

namespace viete::scene {

struct ImportedPoses {
  std::vector<NamedPose> poses;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;  ///< that were read
};

/// As people count: a file of 2 comes before one of 10.
void sort_by_numbers(std::vector<std::filesystem::path>& files);
/// Models of a folder in that order. Throws base::Error where it cannot be read.
std::vector<std::filesystem::path> models_in(const std::filesystem::path& folder);

/// Posed cages, each a pose of its file's name, with the turns that it says; a glTF file with morph targets
/// gives a pose a target. A folder stands for the models in it, in the order of their names (numbers by what
/// they count), and those that are no poses of the cage are left out with a warning. Throws base::Error:
/// a named file that is none, no pose at all, more than a document holds. Thread-safe.
ImportedPoses read_poses(std::span<const std::filesystem::path> files, const deform::Cage& cage,
                         base::Progress* progress = nullptr);

struct ImportedKeys {
  std::vector<PoseKey> keys;  ///< by frame
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;  ///< that were read
};

/// How seconds become frames: those of a file begin at `first`.
struct ImportTimes {
  int first = 1;
  double rate = 24;
};

/// Keys of the cage from
///
/// numbered posed cages   (`pose_####.obj`, or one file of the sequence): the number is the frame; smooth
/// .pc2                   of the cage's vertices: a key a sample, at the frames that it says; linear
/// .mdd                   likewise, at its seconds
/// .glb, .gltf            the cage with morph targets and an animation of their weights: a key a key, at its
///                        seconds; linear
///
/// No whole turns are said but in posed cages: such keys have those nearest to the key before. Of keys that
/// fall on the same frame the first counts, with a warning. Throws base::Error: another number of vertices,
/// no frames, more than a timeline holds, frames beyond it. Thread-safe.
ImportedKeys read_keys(const std::filesystem::path& file, const deform::Cage& cage, const ImportTimes& times,
                       base::Progress* progress = nullptr);

/// Keys that were read take the place of those that are there, as an edit; range with them. Camera keys stay.
void put_keys(Document& document, std::vector<PoseKey> keys, const std::string& label);

/// As write_pose(). Throws base::Error.
void write_named_pose(const Document& document, std::size_t pose, const std::filesystem::path& file);

}  // namespace viete::scene
