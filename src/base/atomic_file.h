// Replaces files atomically: a file has either its old content or its complete new content.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace viete::base {

/// `process`: the new content survives a crash of the process. `power_cut`: the new content also survives a
/// power cut, but replace_file() waits some milliseconds for the disk.
enum class Durability { process, power_cut };

/// Writes the bytes to a new file in the same folder, and renames the new file to `path`. If this fails,
/// removes the new file and does not change the existing file. If `path` is a symbolic link, replaces its
/// target. Keeps the permissions of an existing file and, if the system allows this, its owner. Throws Error
/// for a folder, a device, an unwritable folder, a full disk or a write-protected file (also for root). If
/// the file has several names (hard links), only `path` gets the new content. Thread-safe.
///
/// The new file is `NAME.PROCESS-NUMBER.part`, where PROCESS is process_name(); a long NAME is cut. Also
/// removes `.part` files of this name that killed programs left.
void replace_file(const std::filesystem::path& path, std::string_view bytes,
                  Durability durability = Durability::power_cut);

using ByteSink = std::function<void(std::string_view)>;

/// Like the function above, but writes the bytes in portions, to save memory: calls produce(sink), which must
/// call sink(bytes) for each portion. If produce() throws, the existing file does not change.
void replace_file(const std::filesystem::path& path, const std::function<void(const ByteSink&)>& produce,
                  Durability durability = Durability::power_cut);

/// Replaces several files together. put() writes a new file; replace() renames all new files. Before
/// replace(), no existing file changes. If the system crashes during replace(), only some files are replaced.
class FilesTogether {
public:
  explicit FilesTogether(Durability durability = Durability::power_cut);
  ~FilesTogether();
  FilesTogether(const FilesTogether&) = delete;
  FilesTogether& operator=(const FilesTogether&) = delete;

  /// Throws errors of replace_file() and exceptions of produce().
  void put(const std::filesystem::path& path, const std::function<void(const ByteSink&)>& produce);
  /// Puts a file without replacing another file: if the name is taken, uses a name such as "a-2.png". If a
  /// file with this name and these bytes exists, puts nothing. Returns the path.
  /// Throws errors of put().
  std::filesystem::path put_new(const std::filesystem::path& path, std::string_view bytes);
  void replace();

  struct File;

private:
  std::vector<std::unique_ptr<File>> files_;
  std::map<std::filesystem::path, std::pair<std::size_t, const File*>> new_;  // hash of bytes; by put_new()
  Durability durability_;
};

/// If replace_file() would throw Error for this path, throws the same error. Call this before long work. Also
/// throws Error if the file has several names (hard links). Does not change an existing file.
void check_replaceable(const std::filesystem::path& path);

/// Returns the path if no file has this name. Otherwise, returns a free name such as "viete-2.png". A broken
/// symbolic link counts as a file. The name of a regular file for which fits(file) is true counts as free.
std::filesystem::path unused_name(
    const std::filesystem::path& path,
    const std::function<bool(const std::filesystem::path&)>& fits = [](const auto&) { return false; });

/// Lets SIGINT, SIGTERM and SIGHUP remove this process's `.part` files before they end it. Ignored signals
/// stay ignored.
void remove_parts_at_signals();

/// Calls remove_stale_parts() for the folder of this file. If it is a symbolic link, for that of its target.
void remove_leftovers_beside(const std::filesystem::path& path);

/// Removes `.part` files that killed programs left in a folder. If `file` is not empty, removes only `.part`
/// files of this name. Keeps files of running programs and other users. Folders may be missing. Thread-safe.
void remove_stale_parts(const std::filesystem::path& folder, const std::string& file = "");

}  // namespace viete::base
