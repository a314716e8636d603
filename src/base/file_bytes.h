// Whole files in memory, and functions of paths.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "base/progress.h"

namespace viete::base {

/// Throws Error if the file is missing or not a regular file. (Reading a pipe might never end.)
std::size_t regular_file_size(const std::filesystem::path& path);

/// A whole file in memory.
class FileBytes {
public:
  /// Throws Error like regular_file_size(), and also if the file exceeds `most` bytes, is unreadable or
  /// does not fit in memory. Throws Cancelled.
  FileBytes(const std::filesystem::path& path, Progress* progress = nullptr,
            std::size_t most = std::numeric_limits<std::size_t>::max());

  std::string_view view() const { return {bytes_.get(), size_}; }

private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// Returns true for a regular file with these bytes. Throws Error like FileBytes.
bool has_bytes(const std::filesystem::path& file, std::string_view bytes);

/// Converts ASCII letters to lower case.
std::string lower_case(std::string_view text);

/// Returns the extension in lower case, without the dot.
std::string extension_of(const std::filesystem::path& path);

/// Returns the canonical path of the folder that contains the file.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Returns true for a regular file in the canonical folder or below, after following links.
bool is_file_below(const std::filesystem::path& folder, const std::filesystem::path& file);

/// Resolves a name relative to the folder. Accepts backslashes, because programs on Windows write them.
std::filesystem::path path_beside(const std::filesystem::path& folder, std::string_view name);

}  // namespace viete::base
