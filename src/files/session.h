// A session: a readable file that restores the view and all work.
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

/// The contents of a session file; session.cpp has its keys. Only format, version and model are required.
/// Unknown keys are ignored, for compatibility with newer programs. A damaged value is an error.
///
/// After reading, `cage` is null, `model` and `cage_file` have path and content only; cage_file has a surface
/// if it is in no file. An empty pose means the pose of the keys or, without keys, rest.
struct Session : document::DocumentState {
  document::OpenedSurface model;
  std::filesystem::path origin;                 ///< session of recovered work; absolute; may be empty
  std::optional<std::uint64_t> origin_content;  ///< checksum of that file at the time
  sym3::Method method = sym3::Method::fast;
  std::optional<document::CameraPose> camera;  ///< missing: frame the model
  document::ViewOptions view;
  document::SideWays sides;
  document::Handling handling;
  std::optional<glm::ivec2> window;  ///< in logical pixels
};

/// File names relative to the folder of `file`; absolute, and with the keys of recovered work, if `portable`
/// is false. Throws base::Error.
std::string session_text(const Session& session, const std::filesystem::path& file, bool portable = true);

/// Throws base::Error naming file and key. check_fits() checks that the session fits model and cage.
Session read_session(const std::filesystem::path& file);

/// Throws base::Error naming `file` and the key that does not fit: poses, selection and hidden vertices of
/// another cage, or shapes, pins and a mask of another model. `document` has both and the session's state.
void check_fits(const document::Document& document, const Session& session,
                const std::filesystem::path& file);
/// The same for named poses and keys.
void check_poses(const document::DocumentState& state, const deform::Cage* cage, const mesh::Surface& model,
                 const std::filesystem::path& file);

/// Warnings if the content of model or cage differs from when the session was saved: the pose may then belong
/// to another cage.
std::vector<std::string> changes_since(const Session& session, const document::Document& document,
                                       const std::filesystem::path& file);

inline constexpr const char* session_extension = ".viete";
/// By its extension.
bool is_session(const std::filesystem::path& file);

/// Checksum of a file; nullopt if it cannot be read.
std::optional<std::uint64_t> content_of(const std::filesystem::path& file);

std::uint64_t content_of_bytes(std::string_view bytes);

}  // namespace viete::files
