// Files of one sequence: a pattern with a place for the number, to names and back.
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

/// `frame_####.obj`, as many digits as there are marks, more where the number needs them; or as printf has
/// it: `frame_%04d.obj`, `frame_%d.obj`. The place is in the file's name, not in its folder. Immutable.
class NumberedName {
public:
  /// Throws Error where there is no place for the number, or more than one.
  explicit NumberedName(const std::filesystem::path& pattern);

  /// True if it has a place for the number.
  static bool is_pattern(const std::filesystem::path& path);

  /// Of the sequence that this file is of: the last digits of its name are the number. `a_10` may be of
  /// `a_##` or of `a_#`: of that which has more files. Nothing where its name has no digits. Throws what
  /// find() does.
  static std::optional<NumberedName> of_file(const std::filesystem::path& file);

  /// -7 of `a_####` is `a_-007`, as printf has it.
  std::filesystem::path file(std::int64_t number) const;

  /// The number of a name that file() gives, and of no other: `a_1` is none of `a_##`.
  std::optional<std::int64_t> number(const std::string& name) const;

  /// Those that are there, by number. A folder that is not there holds none. Throws Error if it cannot be
  /// read.
  std::vector<NumberedFile> find() const;

  /// The pattern with marks.
  std::string pattern() const;

private:
  NumberedName(std::filesystem::path folder, std::string before, int digits, std::string after);

  std::filesystem::path folder_;
  std::string before_, after_;
  int digits_ = 1;
};

}  // namespace viete::base
