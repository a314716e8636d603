// Finds and describes recovery files: unsaved work of programs that have ended.
#pragma once

#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "document/camera.h"
#include "mesh/surface.h"

namespace viete::files {

/// A session file with unsaved edits.
struct RecoveryFile {
  std::filesystem::path file;
  std::string name;                ///< file name of the edited session or model
  std::time_t time = 0;            ///< time of the last edit
  std::filesystem::path folder{};  ///< folder of the edited session or model; empty if unknown
  bool restored = false;           ///< true if this file was opened, then closed without further edits
  std::shared_ptr<const mesh::Surface> cage{};  ///< null if there is none or it cannot be read
  std::vector<mesh::Point> posed{};             ///< the cage's vertices in the pose
  document::UpAxis up = document::UpAxis::y;

  friend bool operator==(const RecoveryFile&, const RecoveryFile&) = default;
};

/// Returns the recovery file of the running program: FOLDER/PROCESS.viete, see base::process_name().
std::filesystem::path recovery_file(const std::filesystem::path& folder);
/// Returns a free file name for unsaved work, used when the user opens another file.
std::filesystem::path set_aside_file(const std::filesystem::path& folder);

/// Renames a file to mark it as restored. Returns the new name, or the old name if renaming fails.
std::filesystem::path mark_restored(const std::filesystem::path& file);

RecoveryFile describe_recovery_file(const std::filesystem::path& file);

/// Returns the recovery files of ended programs, newest first. The folder need not exist. Deletes files
/// without unsaved work: files equal to the saved session or, if there is no session, to the cage at rest.
std::vector<RecoveryFile> find_recovery_files(const std::filesystem::path& folder);

/// Formats the local time: "May 03, 14:32".
std::string when(std::time_t time);

}  // namespace viete::files
