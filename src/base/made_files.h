// Which files of a sequence a program has made, and of what, so that a run goes on where another was ended
// and nothing of anybody else is replaced.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/numbered_files.h"

namespace viete::base {

/// A record beside the files, `PATTERN.made`, to which several processes may add at once. It is kept when the
/// work is done: it is what tells the program's own files from those of a user.
class MadeFiles {
public:
  enum class State {
    missing,  ///< nothing is of this name
    whole,    ///< made of the same, not changed since, and what it leads to is there
    ours,     ///< made by the program, of something else, or it is not certain that it is whole
    foreign   ///< made, or changed, by somebody else
  };
  struct Planned {
    std::int64_t number;
    std::uint64_t key;  ///< a checksum of all that the file is made from
  };

  /// Reads what is there; a record that is not there, and lines that are damaged, say nothing. Throws Error
  /// if it cannot be read.
  explicit MadeFiles(NumberedName name);

  const std::filesystem::path& record() const { return record_; }

  /// Reads the file if the record says that it is whole.
  State state(const Planned& file) const;

  /// From now on these may be replaced: to be called before the first of them is. On the disk when it
  /// returns. Throws Error.
  void begin(std::span<const Planned> files);
  /// The file is there as a whole, and `beside` all that it leads to. Throws Error.
  void add(const Planned& file, std::span<const std::filesystem::path> beside = {});

private:
  struct Entry {
    std::uint64_t key = 0, bytes = 0, content = 0;
    std::vector<std::string> beside{};  // names from the folder of the record
    bool begun = false, made = false;   // either or both: the last one that was made, and since begun anew
  };
  void read();
  bool has_all_beside(const Entry& entry) const;
  void append(const std::string& lines, bool sync) const;

  NumberedName name_;
  std::filesystem::path record_;
  std::map<std::int64_t, Entry> entries_;
};

}  // namespace viete::base
