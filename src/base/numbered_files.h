// Sequences of numbered files, whose names follow a pattern.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace viete::base {

struct NumberedFile {
  std::int64_t number = 0;
  std::filesystem::path path;
};

/// A pattern such as `frame_####.obj`. Numbers have at least as many digits as the pattern has marks. The
/// folder has no number. Immutable.
class NumberedName {
public:
  /// Throws Error unless the pattern has exactly one placeholder for the number.
  explicit NumberedName(const std::filesystem::path& pattern);

  static bool is_pattern(const std::filesystem::path& path);

  /// The pattern of the sequence that contains a file: the last digits of the name are the number. For `a_10`
  /// it is `a_##` or `a_#`, whichever has more files. Returns nullopt if the name has no digits. Throws
  /// errors of find().
  static std::optional<NumberedName> of_file(const std::filesystem::path& file);

  /// The file with a number. As in printf, the file of `a_####` with the number -7 is `a_-007`.
  std::filesystem::path file(std::int64_t number) const;

  /// The number in a file name, or nullopt if file() would give another name: `a_1` does not match `a_##`.
  std::optional<std::int64_t> number(const std::string& name) const;

  /// All existing files, sorted by number. A missing folder counts as empty. Throws Error if the folder
  /// cannot be read.
  std::vector<NumberedFile> find() const;

  std::string pattern() const;

private:
  NumberedName(std::filesystem::path folder, std::string before, int digits, std::string after);

  std::filesystem::path folder_;
  std::string before_, after_;
  int digits_ = 1;
};

}  // namespace viete::base
