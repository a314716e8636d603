// Replaces a file as a whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viete::base {

/// What the new content survives once replace_file() has returned: the end of the process, however sudden, or
/// a power cut too, which waits for the disk (milliseconds).
enum class Durability { process, power_cut };

/// Writes the bytes to a new file in the same folder, syncs it, and renames it to path. On failure the
/// existing file stays as it was and the new one is removed. A link is followed. Of an existing file the
/// rights to read, write and run are kept, and its owner where the system allows that; setuid, setgid and
/// sticky bits are not. Throws Error: a folder, a device, an unwritable folder, a full disk, a file whose
/// owner may not write it (root is refused too). Of a file of several names (hard links) this name alone gets
/// the new content, as a backup that is made of such links wants it; see check_replaceable(). Thread-safe.
///
/// The new file is called `NAME.PROCESS-NUMBER.part`, see process_name(). What a program that was killed has
/// left of this file is removed.
void replace_file(const std::filesystem::path& path, std::string_view bytes,
                  Durability durability = Durability::power_cut);

/// The same with bytes that lie in several places, one after the other.
void replace_file(const std::filesystem::path& path, std::span<const std::string_view> parts,
                  Durability durability = Durability::power_cut);

/// Takes a portion of the bytes of a file.
using ByteSink = std::function<void(std::string_view)>;

/// The same with bytes that are made while they are written: produce() hands them on, portion by portion, and
/// no more than a portion needs to be in memory. What it throws is thrown, and the existing file stays as it
/// was.
void replace_file(const std::filesystem::path& path, const std::function<void(const ByteSink&)>& produce,
                  Durability durability = Durability::power_cut);

/// Files that belong together: replace() renames all of them, once each of them is there as a whole; without
/// it all stay as they were. Only a system that dies between two names can part them.
class FilesTogether {
public:
  explicit FilesTogether(Durability durability = Durability::power_cut);
  ~FilesTogether();
  FilesTogether(const FilesTogether&) = delete;
  FilesTogether& operator=(const FilesTogether&) = delete;

  /// Throws what replace_file() throws, and what produce() does.
  void put(const std::filesystem::path& path, const std::function<void(const ByteSink&)>& produce);
  void replace();

private:
  struct File;
  std::vector<std::unique_ptr<File>> files_;
  Durability durability_;
};

/// Throws what replace_file() would throw now for this place, for work that takes long before it writes; and
/// for a file that a user has chosen: throws Error too where it has several names, which a user may not want
/// to be parted. An existing file stays as it is.
void check_replaceable(const std::filesystem::path& path);

/// The path, or where something is of this name, be it a link that leads nowhere: "viete-2.png",
/// "viete-3.png" ... Names of regular files that `fits` accepts count as unused.
std::filesystem::path unused_name(
    const std::filesystem::path& path,
    const std::function<bool(const std::filesystem::path&)>& fits = [](const auto&) { return false; });

/// Removes the parts that programs which were killed have left in the folder of this file; see
/// remove_stale_parts().
void remove_leftovers_beside(const std::filesystem::path& path);

/// Removes every part in a folder of our own that a program left when it was killed. A part of a running
/// program, of another user, or of another form stays. A folder that is not there is empty. Thread-safe.
void remove_stale_parts(const std::filesystem::path& folder);

}  // namespace viete::base
