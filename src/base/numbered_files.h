// Sequences of numbered files. The file names follow a pattern.
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

/// A pattern such as `frame_####.obj`. A number has at least as many digits as the pattern has marks (#). The
/// number is in the file name, not in the folder. Immutable.
class NumberedName {
public:
  /// If the pattern does not have exactly one placeholder for the number, throws Error.
  explicit NumberedName(const std::filesystem::path& pattern);

  static bool is_pattern(const std::filesystem::path& path);

  /// Returns the pattern of the sequence that contains a file. The last digits of the file name are the
  /// number. For `a_10`, returns `a_##` or `a_#`, whichever has more files. If the name has no digits,
  /// returns nullopt. Throws errors of find().
  static std::optional<NumberedName> of_file(const std::filesystem::path& file);

  /// Returns the file with a number. As in printf, the file of `a_####` with the number -7 is `a_-007`.
  std::filesystem::path file(std::int64_t number) const;

  /// Returns the number in a file name, or nullopt for a name that does not fit the pattern.
  std::optional<std::int64_t> number(const std::string& name) const;

  /// Returns all existing files, sorted by number. If the folder is missing, returns no files. If the folder
  /// cannot be read, throws Error.
  std::vector<NumberedFile> find() const;

  std::string pattern() const;

private:
  NumberedName(std::filesystem::path folder, std::string before, int digits, std::string after);

  std::filesystem::path folder_;
  std::string before_, after_;
  int digits_ = 1;
};

}  // namespace viete::base
