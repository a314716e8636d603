// Finds and describes the recovery files with unsaved work of ended programs.
#pragma once

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace viete::files {

/// A session file with unsaved edits.
struct RecoveryFile {
  std::filesystem::path file;
  std::string name;                ///< file name of the edited session or model
  std::time_t time = 0;            ///< time of the last edit
  std::filesystem::path folder{};  ///< folder of the edited session or model; empty if unknown
  bool restored = false;           ///< true: it was opened and closed without further edits

  friend bool operator==(const RecoveryFile&, const RecoveryFile&) = default;
};

/// The recovery file of the running program: FOLDER/PROCESS.viete, see base::process_name().
std::filesystem::path recovery_file(const std::filesystem::path& folder);
/// A free name for the unsaved work of a document that the user replaces by opening another file.
std::filesystem::path set_aside_file(const std::filesystem::path& folder);

/// Marks a file as restored by renaming it. Returns the new name, or the old name if renaming fails.
std::filesystem::path mark_restored(const std::filesystem::path& file);

RecoveryFile describe_recovery_file(const std::filesystem::path& file);

/// The recovery files of ended programs, newest first. Deletes a file if its work equals the saved session
/// or, if there is no session, the cage at rest. Empty if the folder does not exist.
std::vector<RecoveryFile> find_recovery_files(const std::filesystem::path& folder);

/// The local time: "May 03, 14:32".
std::string when(std::time_t time);

}  // namespace viete::files
