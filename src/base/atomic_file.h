// Replaces files atomically: a file has either its old content or its complete new content.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace viete::base {

/// `process`: the new content survives a crash of the process. `power_cut`: the new content also survives a
/// power cut, but replace_file() waits some milliseconds for the disk.
enum class Durability { process, power_cut };

/// Writes the bytes to a new file in the same folder, and renames the file to `path`. If this fails, removes
/// the new file and does not change the existing file. Follows links. Keeps the read, write and execute
/// permissions of an existing file and, if the system allows it, the owner. Throws Error for a folder, a
/// device, an unwritable folder, a full disk, or a file that its owner may not write, even if root writes. If
/// the file has hard links, only this name gets the new content; see check_replaceable(). Thread-safe.
///
/// The new file is `NAME.PROCESS-NUMBER.part`, where PROCESS is process_name(). If killed programs left such
/// files for this name, removes them.
void replace_file(const std::filesystem::path& path, std::string_view bytes,
                  Durability durability = Durability::power_cut);

using ByteSink = std::function<void(std::string_view)>;

/// Like the function above, but calls produce(). produce() passes the bytes in portions, to save memory. If
/// produce() throws, rethrows the exception and does not change the existing file.
void replace_file(const std::filesystem::path& path, const std::function<void(const ByteSink&)>& produce,
                  Durability durability = Durability::power_cut);

/// Replaces several files together. put() writes a new file; replace() renames all new files. Without
/// replace(), no existing file changes. If the system crashes during replace(), only some files are replaced.
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

/// Throws the error that replace_file() would throw for this path. Call this before long work. Also throws
/// Error if the file has hard links, because replacing would separate them. Does not change an existing file.
void check_replaceable(const std::filesystem::path& path);

/// Returns the path or, if a file with this name exists, a free name such as "viete-2.png". A broken link
/// counts as an existing file. A regular file for which fits(file) is true counts as free.
std::filesystem::path unused_name(
    const std::filesystem::path& path,
    const std::function<bool(const std::filesystem::path&)>& fits = [](const auto&) { return false; });

/// Calls remove_stale_parts() for this file and its folder.
void remove_leftovers_beside(const std::filesystem::path& path);

/// Removes `.part` files that killed programs left in a folder: for one file or, if `file` is empty, for all.
/// Keeps files of running programs and of other users. If the folder is missing, does nothing. Thread-safe.
void remove_stale_parts(const std::filesystem::path& folder, const std::string& file = "");

}  // namespace viete::base
