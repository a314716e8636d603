// Images of materials, where another format wants them: within its file, or as files beside it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/original.h"

namespace viete::mesh {

/// Larger files are no images of a model, whatever it says.
inline constexpr std::size_t most_image_bytes = std::size_t{1} << 29;

/// Files that belong to one that is being written. None takes the place of another; without keep() those
/// that are new go again.
class FilesBeside {
public:
  explicit FilesBeside(const std::filesystem::path& model);
  ~FilesBeside();
  FilesBeside(const FilesBeside&) = delete;
  FilesBeside& operator=(const FilesBeside&) = delete;

  /// Its name: this one, or the next free one; that of a file with the very same bytes if there is one.
  /// Throws base::Error.
  std::string put(const std::string& name, std::string_view bytes);
  /// Copies a file to a name (folders may be in it). False where another file has that name. Throws
  /// base::Error.
  bool copy(const std::filesystem::path& file, const std::filesystem::path& name);
  void keep() { written_.clear(); }

  const std::filesystem::path& folder() const { return folder_; }
  const std::filesystem::path& model() const { return model_; }

private:
  std::filesystem::path model_, folder_;
  std::vector<std::filesystem::path> written_;
};

/// Copies what a file leads to, so that what is written again in another folder finds it too. What is outside
/// of the old folder stays. Returns what a person should know, one line each.
std::vector<std::string> copy_companions(const Companions& companions, FilesBeside& beside);

/// A folder as the system knows it, without links and dots; of a file, the one that it lies in.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// How a file is named from a folder_of(): "../textures/wood.png".
std::filesystem::path way_to(const std::filesystem::path& file, const std::filesystem::path& folder);

/// What a person should know where a file that is written leads to others that lie elsewhere.
std::string stayed_note(const std::string& what, const std::filesystem::path& file);

/// What materials use lies within afterwards, as PNG or JPEG, which is all that glTF takes: others are
/// decoded and become PNG. One that is not to be had is left out. Returns what a person should know, one line
/// each.
std::vector<std::string> take_images_within(Attributes& attributes);

/// What materials use and lies within becomes files beside, as they are; the paths of all are those from
/// there. Returns what a person should know, one line each. Throws base::Error.
std::vector<std::string> put_images_beside(FilesBeside& beside, Attributes& attributes);

}  // namespace viete::mesh
