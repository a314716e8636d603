// Session files, which store the view and all work.
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
/// ignored, because newer programs may write them. An invalid value is an error.
///
/// After reading, `cage` is null; `model` and `cage_file` have only path and content, but a cage without a
/// file also has its surface. An empty pose means the pose of the keys or, if there are no keys, rest.
struct Session : document::DocumentState {
  document::OpenedSurface model;
  std::filesystem::path origin;  ///< absolute path of the session whose edits are unsaved; or empty
  std::optional<std::uint64_t> origin_content;  ///< checksum of that file when it was opened or saved
  sym3::Method method = sym3::Method::fast;
  std::optional<document::CameraPose> camera;  ///< missing: the camera frames the model
  document::ViewOptions view;
  document::SideWays sides;
  document::Handling handling;
  std::optional<glm::ivec2> window;  ///< in logical pixels
};

/// The text of the session file `file`. portable: file names are relative to its folder; otherwise they are
/// absolute, and the origin is written too. Throws base::Error.
std::string session_text(const Session& session, const std::filesystem::path& file, bool portable = true);

/// Throws base::Error with file and key. Does not check that the session fits the model and cage.
Session read_session(const std::filesystem::path& file);

/// Throws base::Error with `file` and the key if poses, selection or hidden vertices do not fit the cage, or
/// shapes, pins or the mask do not fit the model. document: has model, cage and the state of the session.
void check_fits(const document::Document& document, const Session& session,
                const std::filesystem::path& file);
/// As check_fits(), but only for named poses and keys.
void check_poses(const document::DocumentState& state, const deform::Cage* cage, const mesh::Surface& model,
                 const std::filesystem::path& file);

/// Warnings if the file of the model or cage has changed since the session was saved.
std::vector<std::string> changes_since(const Session& session, const document::Document& document,
                                       const std::filesystem::path& file);

inline constexpr const char* session_extension = ".viete";
/// True if the file has the extension of a session.
bool is_session(const std::filesystem::path& file);

/// Checksum of a file; nullopt if it cannot be read.
std::optional<std::uint64_t> content_of(const std::filesystem::path& file);

std::uint64_t content_of_bytes(std::string_view bytes);

}  // namespace viete::files
