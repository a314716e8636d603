// The files used by a command or an open document, identified by inode instead of name.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace viete::document {

struct FileInUse {
  std::filesystem::path path;
  std::string_view what;  ///< "the model"; a string with static lifetime
};

using FileIdentity = std::variant<std::pair<dev_t, ino_t>, std::filesystem::path>;

class FilesInUse {
public:
  FilesInUse() = default;
  FilesInUse(std::initializer_list<std::filesystem::path> files);

  /// `what` describes the file: "the model". Ignores an empty path.
  void add(const std::filesystem::path& file, std::string_view what);

  /// The description of this file, regardless of spelling and links; null: not in use. A missing file is
  /// compared by name.
  const std::string* find(const std::filesystem::path& file) const;

private:
  std::map<FileIdentity, std::string> files_;
};

/// Descriptions of files in use; the argument `own` is one of the first four.
inline constexpr std::string_view the_session = "the session", the_cage = "the cage", the_pose = "the pose",
                                  no_own = "", the_model = "the model", the_keys = "the keys",
                                  an_imported_pose = "an imported pose", a_shape = "a shape",
                                  the_mask = "the mask";

}  // namespace viete::document
