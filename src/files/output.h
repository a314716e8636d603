// Checks files before they are overwritten.
#pragma once

#include <array>
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
class Document;
}

namespace viete::files {

enum class Content { surface, picture, json, animation, session, page, film };

enum class Force {
  none,     ///< the user cannot override the check
  offered,  ///< errors advise the user to add --force
  given     ///< the user has added --force
};

/// Call this before a long computation. If the file cannot be written, throws base::Error. Without
/// Force::given, also throws if the file is in `files`, or has another kind of content than `content`. The
/// first bytes of the file decide its kind, not the file name. An empty name or an empty file is allowed.
void check_output(const std::filesystem::path& file, Content content, const document::FilesInUse& files,
                  Force force);
inline void check_output(const std::filesystem::path& file, Content content,
                         const document::FilesInUse& files, bool force) {
  check_output(file, content, files, force ? Force::given : Force::offered);
}

struct FrameSteps {
  int first = 1, last = 0, step = 1;
};

/// The extensions of films, which ffmpeg makes of pictures.
inline constexpr std::array<std::string_view, 3> film_formats = {"mp4", "webm", "gif"};
bool is_film(const std::filesystem::path& file);

/// Checks the output of an animation: one file or, for a pattern, the files of all frames. Files of a pattern
/// must not be input files, even with Force::given: the export could read a file after overwriting it.
void check_output(const std::filesystem::path& file, const FrameSteps& frames,
                  const document::FilesInUse& files, Force force);

/// Without Force::given, throws base::Error if the file of a frame exists.
void check_frames_are_new(const base::NumberedName& name, std::span<const int> frames, Force force);

/// Returns `file` if it does not exist and is not in use. Otherwise returns a free name in its folder.
std::filesystem::path proposed_name(const std::filesystem::path& file, const document::FilesInUse& files);

/// Adds a surface's file and the files that the surface uses, such as images. `what` describes the surface.
void add_surface(document::FilesInUse& files, const std::filesystem::path& file,
                 const formats::Original* original, const formats::Attributes* attributes,
                 std::string_view what);

/// Adds all files from which a document was read, except files described as `own`, such as "the cage".
void add_document(document::FilesInUse& files, const document::Document& document,
                  std::string_view own = document::no_own);

}  // namespace viete::files
