// The files that a command or a document uses. A file is recognized under any of its names.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "base/os.h"

namespace viete::document {

struct FileInUse {
  std::filesystem::path path;
  std::string_view what;  ///< a string with static lifetime, such as "the model"
};

using FileIdentity = std::variant<base::os::FileId, std::filesystem::path>;

class FilesInUse {
public:
  FilesInUse() = default;
  FilesInUse(std::initializer_list<std::filesystem::path> files);

  /// Adds a file. `what` describes the file, such as "the model". If the path is empty, does nothing.
  void add(const std::filesystem::path& file, std::string_view what);

  /// Returns the description of the file. If the file is not in use, returns null. The path may be a symbolic
  /// link. If the file does not exist, compares absolute paths.
  const std::string* find(const std::filesystem::path& file) const;

private:
  std::map<FileIdentity, std::string> files_;
};

/// The descriptions for FileInUse::what.
inline constexpr std::string_view the_session = "the session", the_cage = "the cage", the_pose = "the pose",
                                  no_own = "", the_model = "the model", the_keys = "the keys",
                                  an_imported_pose = "an imported pose", a_shape = "a shape",
                                  the_mask = "the mask";

}  // namespace viete::document
