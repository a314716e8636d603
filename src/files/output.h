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

/// none: the check cannot be overridden. offered: --force would override the check. given: it was used.
enum class Force { none, offered, given };

/// Call before a long computation. Throws base::Error if the file cannot be written or, unless forced, if it
/// is in `files` or contains another kind of content. Detects the kind from the beginning of the file, not
/// from its name. Empty names and empty files pass.
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
/// input file, even if forced, because the export may still read this file after it was overwritten.
void check_output(const std::filesystem::path& file, const FrameSteps& frames,
                  const document::FilesInUse& files, Force force);

/// Throws base::Error if a file of these frames exists, unless `force` is given.
void check_frames_are_new(const base::NumberedName& name, std::span<const int> frames, Force force);

/// `file` if it does not exist and is not in use; otherwise a free name in the same folder.
std::filesystem::path proposed_name(const std::filesystem::path& file, const document::FilesInUse& files);

/// Adds a surface's file and its dependencies: material libraries, images, buffers. `what`: "the model".
void add_surface(document::FilesInUse& files, const std::filesystem::path& file,
                 const formats::Original* original, const formats::Attributes* attributes,
                 std::string_view what);

/// Adds all files from which a document was read, except the file described by `own`.
void add_document(document::FilesInUse& files, const document::Document& document,
                  std::string_view own = document::no_own);

}  // namespace viete::files
