// What a result may be written over: the one rule of window and command line.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "scene/document/files_in_use.h"

namespace viete::mesh {
class Original;
struct Attributes;
}  // namespace viete::mesh

namespace viete::base {
class NumberedName;
}

namespace viete::scene {

struct Document;

/// What is written.
enum class Content { surface, picture, json, svg, animation, session, page };

/// Whether a user may insist, and does.
enum class Force { none, offered, given };

/// Before the work starts: throws base::Error where the file cannot be written, where it is one of those in
/// use, or where its content is of another kind than the result. The last two not with `force`. An empty name
/// passes, and so does an empty file. The beginning of the file tells its kind, never its name. The error
/// names what was found and proposes another name.
void check_output(const std::filesystem::path& file, Content content, const FilesInUse& files, Force force);
inline void check_output(const std::filesystem::path& file, Content content, const FilesInUse& files,
                         bool force) {
  check_output(file, content, files, force ? Force::given : Force::offered);
}

/// From the first one every so many.
struct FrameSteps {
  int first = 1, last = 0, step = 1;
};

/// The same of an animation: of one file, or of a pattern and the frames that give it numbers. Nothing forces
/// the latter over what is read, which would be gone halfway.
void check_output(const std::filesystem::path& file, const FrameSteps& frames, const FilesInUse& files,
                  Force force);

/// Throws base::Error where a file of these frames is there already, unless `force` is given.
void check_frames_are_new(const base::NumberedName& name, std::span<const int> frames, Force force);

/// Beside the first one: a name that is neither taken nor in use; the name itself, where what is there may be
/// replaced.
std::filesystem::path proposed_name(const std::filesystem::path& file, const FilesInUse& files);

/// A surface's file and all that this leads to: material libraries, images, buffers. `what`: "the model".
void add_surface(FilesInUse& files, const std::filesystem::path& file, const mesh::Original* original,
                 const mesh::Attributes* attributes, std::string_view what);

/// All that a document was read from, but for the one of `own`: what it was read as.
void add_document(FilesInUse& files, const Document& document, std::string_view own = no_own);

}  // namespace viete::scene
