// The bytes of a file to be read: what they are called, and who is told how far reading has come.
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

/// What every reader is given. The bytes outlive the reading.
struct Source {
  std::string name;        ///< how messages call it: the path as it was given
  std::string extension;   ///< lower case, without the dot; may be empty
  std::string_view bytes;  ///< may hold anything
  base::Progress* progress = nullptr;
  /// Keeps the bytes for who writes the file again; null: they are there for reading alone.
  std::shared_ptr<const void> owner = nullptr;
  std::filesystem::path folder = {};  ///< of files that this one names; empty: they are not looked for
  bool played = false;  ///< who reads it plays its morph targets: the surface is that without them

  /// Reading from disk is the first fifth, this is the rest: done in [0, 1]. Throws base::Cancelled.
  void report(double done) const {
    if (progress) progress->report(0.2 + 0.8 * done);
  }

  /// `name: element 12`, the place of an error in a binary file. Counted from 0.
  std::string place(std::string_view element, std::size_t index) const;
};

/// A whole file in memory.
class FileBytes {
public:
  /// Throws base::Error if there is no such file, if it is not a regular file (a pipe might never end), if it
  /// has more than `most` bytes, cannot be read or does not fit into memory; throws base::Cancelled.
  FileBytes(const std::filesystem::path& path, base::Progress* progress,
            std::size_t most = std::numeric_limits<std::size_t>::max());

  std::string_view view() const { return {bytes_.get(), size_}; }

private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// The beginning of a file, from which its format is judged without reading all of it.
class Beginning {
public:
  /// Empty if the file cannot be read.
  explicit Beginning(const std::filesystem::path& file);

  std::string_view bytes() const { return bytes_; }
  std::uint64_t file_size() const { return file_size_; }
  bool is_whole_file() const { return bytes_.size() == file_size_; }
  /// Without a last line that is cut off.
  Source whole_lines() const;

private:
  std::string bytes_;
  std::uint64_t file_size_ = 0;
};

/// The extension of a path in lower case, without the dot.
std::string extension_of(const std::filesystem::path& path);

/// A folder as the system knows it, without links and dots; of a file, the one that it lies in.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// A file as one in this folder names it: programs on Windows write backslashes.
std::filesystem::path path_beside(const std::filesystem::path& folder, std::string_view name);

}  // namespace viete::mesh
