// Unsaved work that outlived its program: where it lies, and what to tell the user about it.
#pragma once

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace viete::scene {

/// A session file that a program kept because its edits were in no other file.
struct Leftover {
  std::filesystem::path file;
  std::string name;                ///< of its session or model, for people
  std::time_t time = 0;            ///< of its last edit
  std::filesystem::path folder{};  ///< of its session or model; empty: not known
  std::string first_edit{};        ///< since that was saved last: "move 3 vertices"; empty: not known
  bool restored = false;           ///< opened once and closed without further edits

  friend bool operator==(const Leftover&, const Leftover&) = default;
};

/// Where the running program keeps its work: PROCESS.viete in the folder, see base::process_name().
std::filesystem::path recovery_file(const std::filesystem::path& folder);
/// Another name of this program in that folder, for work that was set aside when another file was opened.
std::filesystem::path set_aside_file(const std::filesystem::path& folder);

/// Renames the file of a leftover that was opened and closed without further edits. Returns the new name, or
/// the old one if renaming fails.
std::filesystem::path mark_restored(const std::filesystem::path& file);

Leftover describe_leftover(const std::filesystem::path& file);

/// Newest first; only those whose program has ended. Removes those that equal the files on disk. Empty if
/// there is no such folder.
std::vector<Leftover> find_leftovers(const std::filesystem::path& folder);

/// "today 14:32", "yesterday 14:32", "May 03, 14:32", "May 03 2024, 14:32".
std::string when(std::time_t time, std::time_t now);

}  // namespace viete::scene
