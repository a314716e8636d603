// Session files store the view and all work.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "document/camera.h"
#include "document/document.h"
#include "document/handling.h"
#include "document/view_options.h"

namespace viete::files {

/// The contents of a session file. Only the keys format, version and model are required. Unknown keys are
/// ignored with a note, because newer programs may write them. An invalid value is an error.
///
/// After reading, `cage` is null, and `model` and `cage_file` have a path and a checksum of the content. If
/// the cage has no path, `cage_file` has its surface. An empty `pose` is the pose of the keys or, without
/// keys, the rest pose.
struct Session : document::DocumentState {
  document::OpenedSurface model;
  std::filesystem::path origin;  ///< in recovery files: absolute path of the edited session; or empty
  std::optional<std::uint64_t> origin_content;  ///< checksum of the file `origin` when opened or saved
  sym3::Method method = sym3::Method::fast;
  std::optional<document::CameraPose> camera;  ///< if missing, the camera shows the whole model
  document::ViewOptions view;
  document::SideViews sides;
  document::Handling handling;
  std::optional<glm::ivec2> window;  ///< size in logical pixels
  std::vector<std::string> notes;    ///< about the file; not written
};

/// Returns the text of the session file `file`. If `portable`, file names are relative to the folder of
/// `file`. Otherwise file names are absolute, and the text also contains `origin`. Throws base::Error.
std::string session_text(const Session& session, const std::filesystem::path& file, bool portable = true);

/// Throws base::Error with file and key. Does not check that the session matches the model and cage.
Session read_session(const std::filesystem::path& file);

/// Poses, selection and hidden vertices must fit the cage. Shapes, pins and mask must fit the model.
/// Otherwise throws base::Error with `file` and the key. The document must have the session's state.
void check_fits(const document::Document& document, const Session& session,
                const std::filesystem::path& file);

/// Returns warnings if the file of the model or cage has changed since the session was saved.
std::vector<std::string> changes_since(const Session& session, const document::Document& document,
                                       const std::filesystem::path& file);

inline constexpr const char* session_extension = ".viete";
/// Returns true if the file has the extension of a session.
bool is_session(const std::filesystem::path& file);

/// Returns the checksum of a file, or nullopt if the file cannot be read.
std::optional<std::uint64_t> content_of(const std::filesystem::path& file);

std::uint64_t content_of_bytes(std::string_view bytes);

}  // namespace viete::files
