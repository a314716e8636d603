// Replaces files atomically: completely or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace viete::base {

/// `process`: the new content survives a crash of the process. `power_cut`: it also survives a power cut, but
/// replace_file() waits some milliseconds for the disk.
enum class Durability { process, power_cut };

/// Writes the bytes to a new file in the same folder and renames it to `path`. If this fails, the existing
/// file is unchanged and the new file is removed. Follows links. Keeps the read, write and execute
/// permissions of an existing file, and its owner if the system allows it. Throws Error for a folder, a
/// device, an unwritable folder, a full disk, or a file whose owner may not write it, even if root writes. If
/// the file has hard links, only this name gets the new content, see check_replaceable(). Thread-safe.
///
/// The new file is `NAME.PROCESS-NUMBER.part`, where PROCESS is process_name(). Removes such files that
/// killed programs left for this name.
void replace_file(const std::filesystem::path& path, std::string_view bytes,
                  Durability durability = Durability::power_cut);

using ByteSink = std::function<void(std::string_view)>;

/// As above, but calls produce(), which passes the bytes in portions, so that memory contains only one
/// portion. If produce() throws, rethrows the exception and leaves the existing file unchanged.
void replace_file(const std::filesystem::path& path, const std::function<void(const ByteSink&)>& produce,
                  Durability durability = Durability::power_cut);

/// Replaces several files together. put() writes new files; replace() renames all of them. Without replace()
/// all files stay unchanged. If the system crashes between two renames, only some files are replaced.
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

/// Throws the error that replace_file() would throw for this path, to report it before long work. Also throws
/// Error if the file has hard links, which replacing would separate. Does not change an existing file.
void check_replaceable(const std::filesystem::path& path);

/// The path or, if a file with this name exists, a free name such as "viete-2.png". A broken link counts as
/// an existing file. A regular file for which fits(file) is true does not count.
std::filesystem::path unused_name(
    const std::filesystem::path& path,
    const std::function<bool(const std::filesystem::path&)>& fits = [](const auto&) { return false; });

/// Calls remove_stale_parts() for the folder of this file.
void remove_leftovers_beside(const std::filesystem::path& path);

/// Removes the `.part` files that killed programs left in a folder, for one file or for all files. Keeps
/// files of running programs and of other users. A missing folder counts as empty. Thread-safe.
void remove_stale_parts(const std::filesystem::path& folder, const std::string& file = "");

}  // namespace viete::base
