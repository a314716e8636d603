// Numbered file sequences: patterns to file names and back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace viete::base {

struct NumberedFile {
  std::int64_t number = 0;
  std::filesystem::path path;
};

/// A pattern `frame_####.obj`, with at least as many digits as marks, or in printf style: `frame_%04d.obj`,
/// `frame_%d.obj`. The number is in the file's name, not in its folder. Immutable.
class NumberedName {
public:
  /// Throws Error unless the pattern has exactly one place for the number.
  explicit NumberedName(const std::filesystem::path& pattern);

  /// True if it has a place for the number.
  static bool is_pattern(const std::filesystem::path& path);

  /// The pattern of this file's sequence: the last digits of its name are the number. For `a_10` that is
  /// `a_##` or `a_#`, whichever has more files. Nothing if its name has no digits. Throws errors of find().
  static std::optional<NumberedName> of_file(const std::filesystem::path& file);

  /// -7 of `a_####` is `a_-007`, as in printf.
  std::filesystem::path file(std::int64_t number) const;

  /// The number of a name; nothing unless file() gives this name: `a_1` does not match `a_##`.
  std::optional<std::int64_t> number(const std::string& name) const;

  /// Existing files, sorted by number. A missing folder counts as empty. Throws Error if the folder cannot be
  /// read.
  std::vector<NumberedFile> find() const;

  /// The pattern with `#` marks.
  std::string pattern() const;

private:
  NumberedName(std::filesystem::path folder, std::string before, int digits, std::string after);

  std::filesystem::path folder_;
  std::string before_, after_;
  int digits_ = 1;
};

}  // namespace viete::base
