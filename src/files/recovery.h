// Unsaved work of ended programs: its files, and their description for the user.
#pragma once

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace viete::files {

/// A recovery file: a session with edits that were not saved to any other file.
struct RecoveryFile {
  std::filesystem::path file;
  std::string name;                ///< display name of its session or model
  std::time_t time = 0;            ///< time of its last edit
  std::filesystem::path folder{};  ///< folder of its session or model; empty: unknown
  bool restored = false;           ///< opened once and closed without further edits

  friend bool operator==(const RecoveryFile&, const RecoveryFile&) = default;
};

/// The recovery file of the running program: PROCESS.viete in the folder, see base::process_name().
std::filesystem::path recovery_file(const std::filesystem::path& folder);
/// Another recovery file of this program, for unsaved work of a document replaced by opening another file.
std::filesystem::path set_aside_file(const std::filesystem::path& folder);

/// Renames a recovery file that was opened and closed without further edits. Returns the new name, or the old
/// one if renaming fails.
std::filesystem::path mark_restored(const std::filesystem::path& file);

RecoveryFile describe_recovery_file(const std::filesystem::path& file);

/// The recovery files of ended programs, newest first. Deletes files whose work equals their session on disk
/// or, without a session, the cage at rest. Empty if the folder does not exist.
std::vector<RecoveryFile> find_recovery_files(const std::filesystem::path& folder);

/// The local time in words: "May 03, 14:32".
std::string when(std::time_t time);

}  // namespace viete::files
