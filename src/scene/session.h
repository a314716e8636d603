// A session: everything that makes the picture, as a readable file that leads back to it.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/workspace.h"

namespace viete::scene {

/// What a session file holds. JSON, version 1:
///   "format": "viete session", "version": 1,
///   "model", "cage"       file names, relative to the session's folder; no cage: the key is missing; names
///                         that are not UTF-8 as path_json() writes them
///   "session"             only in recovered work: the session file that it belongs to
///   "session_content"     likewise: checksum of that file as it was then, 16 hexadecimal digits
///   "method"              "diag", "sd", "improved_sd" or "fast"
///   "coordinates"         "face" or "mvc"
///   "reach"               of faces, 1.5 or more; missing: the whole cage
///   "camera"              "target" [x, y, z] and "distance" in view units (model diagonal = 2), "yaw" and
///                         "pitch" in radians, "orthographic"
///   "view"                flags, see ViewOptions
///   "window"              [width, height] in logical pixels
///   "selecting"           "vertices", "edges" or "faces" of the cage
///   "selection"           their indices, from 0
///   "pose"                "turns": rotation vectors in radians, one per part of the cage;
///                         "positions": [x, y, z] per cage vertex
/// Only format, version and model are required. Unknown keys are ignored, so that newer programs may add
/// some.
struct Session {
  std::filesystem::path model, cage;  ///< absolute; cage may be empty
  std::filesystem::path origin;       ///< "session"; absolute; may be empty
  std::optional<std::uint64_t> origin_content;
  sym3::Method method = sym3::Method::fast;
  deform::Coordinates coordinates = deform::Coordinates::face;
  double reach = deform::whole_cage;
  std::optional<CameraPose> camera;  ///< missing: the model is framed
  ViewOptions view;
  std::optional<glm::ivec2> window;
  ElementKind selecting = ElementKind::vertex;
  std::vector<std::uint32_t> selection;
  std::optional<deform::Pose> pose;  ///< missing: at rest
};

Session session_of(const Workspace& workspace);

/// File names relative to the folder of `file`; absolute with `portable` false. Throws base::Error.
std::string session_text(const Session& session, const std::filesystem::path& file, bool portable = true);

/// Throws base::Error naming file and key. Whether the pose fits the cage is not known here: see check_fits.
Session read_session(const std::filesystem::path& file);

/// Throws base::Error naming `file` and the key that does not fit.
void check_fits(const Session& session, const deform::Cage& cage, const std::filesystem::path& file);

/// By its extension, .viete.
bool is_session(const std::filesystem::path& file);

}  // namespace viete::scene
