// The bytes of a file to be read, its name and progress.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "base/progress.h"

namespace viete::mesh {

/// Input of every reader. The bytes must outlive the reading.
struct Source {
  std::string name;        ///< path as given, for messages
  std::string extension;   ///< lower case, without the dot; may be empty
  std::string_view bytes;  ///< arbitrary, not trusted
  base::Progress* progress = nullptr;
  /// Keeps the bytes alive for writing the file again; null: available only during reading.
  std::shared_ptr<const void> owner = nullptr;
  std::filesystem::path folder = {};  ///< folder of external files; empty: do not look for them
  bool played = false;                ///< the caller plays morph targets: the surface excludes them

  /// Reading from disk is the first fifth of progress; done in [0, 1] is the rest. Throws base::Cancelled.
  void report(double done) const {
    if (progress) progress->report(0.2 + 0.8 * done);
  }

  /// The place of an error in a binary file: `name: element 12`, counted from 0.
  std::string place(std::string_view element, std::size_t index) const;
};

/// Throws base::Error if the file is missing or not a regular file (a pipe might never end).
std::size_t regular_file_size(const std::filesystem::path& path);

/// A whole file in memory.
class FileBytes {
public:
  /// Throws base::Error too if the file is larger than `most` bytes, unreadable or larger than memory; throws
  /// base::Cancelled.
  FileBytes(const std::filesystem::path& path, base::Progress* progress,
            std::size_t most = std::numeric_limits<std::size_t>::max());

  std::string_view view() const { return {bytes_.get(), size_}; }

private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// The beginning of a file, enough to detect its format.
class Beginning {
public:
  /// Empty if the file cannot be read.
  explicit Beginning(const std::filesystem::path& file);

  std::string_view bytes() const { return bytes_; }
  std::uint64_t file_size() const { return file_size_; }
  bool is_whole_file() const { return bytes_.size() == file_size_; }
  /// Without a truncated last line.
  Source whole_lines() const;

private:
  std::string bytes_;
  std::uint64_t file_size_ = 0;
};

/// ASCII letters in lower case.
std::string lower_case(std::string_view text);

/// The extension in lower case, without the dot.
std::string extension_of(const std::filesystem::path& path);

/// The canonical folder of a file, or the canonical form of a folder.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Resolves a name relative to the folder; accepts backslashes, which programs on Windows write.
std::filesystem::path path_beside(const std::filesystem::path& folder, std::string_view name);

}  // namespace viete::mesh
