// Replaces a file as a whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace viete::base {

/// The events that new content survives after replace_file() returns: a sudden end of the process, or also a
/// power cut, which requires waiting for the disk (milliseconds).
enum class Durability { process, power_cut };

/// Writes the bytes to a new file in the same folder, syncs it, and renames it to path. On failure the
/// existing file is unchanged and the new one is removed. Follows links. Keeps an existing file's read, write
/// and execute permissions, and its owner if the system allows that, but not setuid, setgid and sticky bits.
/// Throws Error for a folder, a device, an unwritable folder, a full disk, or a file that its owner may not
/// write (also for root). If the file has hard links, only this name gets the new content, as backups made of
/// hard links require; see check_replaceable(). Thread-safe.
///
/// The new file is called `NAME.PROCESS-NUMBER.part`, see process_name(). Removes such files that killed
/// programs left for this file.
void replace_file(const std::filesystem::path& path, std::string_view bytes,
                  Durability durability = Durability::power_cut);

/// Receives a portion of a file's bytes.
using ByteSink = std::function<void(std::string_view)>;

/// The same with bytes that produce() generates and passes on in portions, so that only one portion needs to
/// be in memory. Rethrows exceptions of produce(); the existing file is then unchanged.
void replace_file(const std::filesystem::path& path, const std::function<void(const ByteSink&)>& produce,
                  Durability durability = Durability::power_cut);

/// Replaces several files together: replace() renames all of them once each is complete; without it all stay
/// unchanged. Only a system crash between two renames can replace some of them.
class FilesTogether {
public:
  explicit FilesTogether(Durability durability = Durability::power_cut);
  ~FilesTogether();
  FilesTogether(const FilesTogether&) = delete;
  FilesTogether& operator=(const FilesTogether&) = delete;

  /// Throws errors of replace_file() and exceptions of produce().
  void put(const std::filesystem::path& path, const std::function<void(const ByteSink&)>& produce);
  void replace();

  struct File;

private:
  std::vector<std::unique_ptr<File>> files_;
  Durability durability_;
};

/// Throws the error that replace_file() would throw for this path; call it before work that takes long. For a
/// file that a user has chosen: also throws Error if it has hard links, which replacing would separate. Does
/// not change an existing file.
void check_replaceable(const std::filesystem::path& path);

/// The path or, if its name is taken (even by a broken link), "viete-2.png", "viete-3.png" ... Names of
/// regular files that `fits` accepts count as unused.
std::filesystem::path unused_name(
    const std::filesystem::path& path,
    const std::function<bool(const std::filesystem::path&)>& fits = [](const auto&) { return false; });

/// Removes parts that killed programs left in the folder of this file; see remove_stale_parts().
void remove_leftovers_beside(const std::filesystem::path& path);

/// Removes the parts that killed programs left in a folder of our own: those of one file, or all. Keeps parts
/// of running programs and other users, and other names. A missing folder counts as empty. Thread-safe.
void remove_stale_parts(const std::filesystem::path& folder, const std::string& file = "");

}  // namespace viete::base
