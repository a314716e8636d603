// The files that a command or an open document is made of, known by file and not by name.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace viete::scene {

struct FileInUse {
  std::filesystem::path path;
  std::string_view what;  ///< "the model"; of a constant
};

class FilesInUse {
public:
  FilesInUse() = default;
  FilesInUse(std::initializer_list<std::filesystem::path> files);

  /// `what` it is: "the model". An empty path is none.
  void add(const std::filesystem::path& file, std::string_view what);

  /// What the file of this name is, however it is spelled and whatever link leads to it; null: not in use.
  /// One that is not there is known by its name.
  const std::string* find(const std::filesystem::path& file) const;

private:
  std::map<std::pair<dev_t, ino_t>, std::string> by_file_;
  std::map<std::filesystem::path, std::string> by_name_;
};

/// What files are in use as; `own` is one of the first four.
inline constexpr std::string_view the_session = "the session", the_cage = "the cage", the_pose = "the pose",
                                  no_own = "", the_model = "the model", the_keys = "the keys",
                                  an_imported_pose = "an imported pose", a_shape = "a shape",
                                  the_mask = "the mask";

}  // namespace viete::scene
