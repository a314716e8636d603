// Checks before files are overwritten, for the window and the command line.
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

/// The kind of content to write.
enum class Content { surface, picture, json, animation, session, page };

/// Whether the user can override the check (offered) and did (given).
enum class Force { none, offered, given };

/// Call before the work starts. Throws base::Error if the file cannot be written, is one of those in use, or
/// has content of another kind than the result; the last two can be forced. An empty name or file passes. The
/// kind is detected from the beginning of the file, not from its name. The error describes the file found and
/// proposes another name.
void check_output(const std::filesystem::path& file, Content content, const document::FilesInUse& files,
                  Force force);
inline void check_output(const std::filesystem::path& file, Content content,
                         const document::FilesInUse& files, bool force) {
  check_output(file, content, files, force ? Force::given : Force::offered);
}

/// Every `step`-th frame from `first` to `last`.
struct FrameSteps {
  int first = 1, last = 0, step = 1;
};

/// Checks the output of an animation: one file, or all files of a numbered pattern. A pattern must never
/// overwrite an input, even if forced, since the export would destroy the input halfway.
void check_output(const std::filesystem::path& file, const FrameSteps& frames,
                  const document::FilesInUse& files, Force force);

/// Throws base::Error if a file of these frames exists, unless `force` is given.
void check_frames_are_new(const base::NumberedName& name, std::span<const int> frames, Force force);

/// A free name next to `file` that is not in use; `file` itself if it may be replaced.
std::filesystem::path proposed_name(const std::filesystem::path& file, const document::FilesInUse& files);

/// Adds a surface's file and its dependencies: material libraries, images, buffers. `what`: "the model".
void add_surface(document::FilesInUse& files, const std::filesystem::path& file,
                 const formats::Original* original, const formats::Attributes* attributes,
                 std::string_view what);

/// Adds all files that a document was read from, except the one described by `own`.
void add_document(document::FilesInUse& files, const document::Document& document,
                  std::string_view own = document::no_own);

}  // namespace viete::files
