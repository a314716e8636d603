// Checks files before they are overwritten.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "document/files_in_use.h"

namespace viete::formats {
class Original;
struct Attributes;
}  // namespace viete::formats

namespace viete::base {
class NumberedName;
}

namespace viete::document {
struct Document;
}

namespace viete::files {

enum class Content { surface, picture, json, animation, session, page };

/// none: the user cannot override the check. offered: --force can override it. given: --force was used.
enum class Force { none, offered, given };

/// Call this before a long computation. If the file cannot be written, throws base::Error. If `force` is not
/// given, also throws if the file is in `files` or has content of another kind. The beginning of the file,
/// not its name, shows the kind. Empty names and empty files are allowed.
void check_output(const std::filesystem::path& file, Content content, const document::FilesInUse& files,
                  Force force);
inline void check_output(const std::filesystem::path& file, Content content,
                         const document::FilesInUse& files, bool force) {
  check_output(file, content, files, force ? Force::given : Force::offered);
}

/// The frames from `first` to `last` in steps of `step`.
struct FrameSteps {
  int first = 1, last = 0, step = 1;
};

/// Checks the output of an animation: one file, or all files of a pattern. A pattern must not contain an
/// input file, even with `force`, because the export could read the file after overwriting it.
void check_output(const std::filesystem::path& file, const FrameSteps& frames,
                  const document::FilesInUse& files, Force force);

/// If a file of these frames exists and `force` is not given, throws base::Error.
void check_frames_are_new(const base::NumberedName& name, std::span<const int> frames, Force force);

/// Returns `file` if it does not exist and is not in use. Otherwise returns a free name in its folder.
std::filesystem::path proposed_name(const std::filesystem::path& file, const document::FilesInUse& files);

/// Adds a surface's file and its dependencies: material libraries, images, buffers. `what`: "the model".
void add_surface(document::FilesInUse& files, const std::filesystem::path& file,
                 const formats::Original* original, const formats::Attributes* attributes,
                 std::string_view what);

/// Adds all files from which a document was read, except the file that `own` describes.
void add_document(document::FilesInUse& files, const document::Document& document,
                  std::string_view own = document::no_own);

}  // namespace viete::files
