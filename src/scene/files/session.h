// A session: a readable file that restores the view and all work.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/document/camera.h"
#include "scene/document/document.h"
#include "scene/document/handling.h"
#include "scene/document/view_options.h"

namespace viete::scene {

/// A run of consecutive vertices with the same share, in 255ths.
struct MaskRun {
  std::uint32_t share, vertices;

  friend bool operator==(const MaskRun&, const MaskRun&) = default;
};

/// The contents of a session file. JSON:
///   "format": "viete session", "version": 1,
///   "model", "cage"       file names, relative to the session's folder; no cage: the key is missing; names
///                         that are not UTF-8 as written by path_json()
///   "made_cage"           instead of "cage", for a cage without a file: "name", "positions": [x, y, z] per
///                         vertex, "polygons": 0-based indices of the corners
///   "model_content", "cage_content"   mesh::content_key() when saved, 16 hexadecimal digits
///   "session"             only in recovered work: the session file that it belongs to
///   "session_content"     likewise: checksum of that file at the time, 16 hexadecimal digits
///   "first_edit"          likewise: display name of the first edit since it was saved
///   "method"              "diag", "sd", "improved_sd" or "fast"
///   "weights", "blend"    names of deform/scheme.h; missing: the default that fits the others
///   "turn", "stretch"     amount of the maps' rotation and stretch, percent, 0 to 200; missing: 100
///   "stitched"            iterations of the stitched solve, 1 to 20; missing: not stitched
///   "pins", "hold"        of stitched models, percent, 0 to 100, see deform::Holding; missing: 0
///   "radius"              of cut-off weights, percent of the cage's size; missing: 25
///   "mask"                run lengths of the painted shares of the model's vertices, in 255ths: [share,
///                         count, share, count, ...]; missing: every vertex follows the cage
///   "probes"              see session_parts.h; missing: none
///   "camera"              see camera_json.h
///   "view"                flags, see ViewOptions
///   "views"               additional views: [{"method", the keys of a scheme, "field": the map,
///                         "other_lines": linear if the first view uses logs}], at most 3; missing: none
///   "wipe"                position of the line between two views, 0.05 to 0.95; missing: side by side
///   "cameras"             as "camera", one for each of "views" if they are not linked; missing: linked
///   "hand"                see session_parts.h; missing: defaults
///   "window"              [width, height] in logical pixels
///   "selecting"           "vertices", "edges" or "faces" of the cage, or "probes"
///   "selection"           their 0-based indices
///   "sets"                named vertex sets of the cage: [{"name", "selecting": element kind to select,
///                         "vertices": 0-based indices}]; missing: none
///   "hidden"              hidden vertices of the cage; missing: none
///   "pose"                "turns": rotation vectors in radians, one per part of the cage;
///                         "positions": [x, y, z] per cage vertex
///   "poses", "time"       named poses and keys: see pose_json.h; missing: none
///   "unmixed"             while poses are mixed: the pose without the mix
///   "shapes"              of the model, referenced by poses and keys by index: see pose_json.h; missing:
///   none
///   "shape"               index of the model's current shape; missing: at rest
/// Only format, version and model are required. Unknown keys are ignored, for compatibility with newer
/// programs. Ranges: scene/document/range.h. A damaged part counts as missing, with a warning, except model,
/// cage and the list of positions, where it is an error.
struct Session {
  std::filesystem::path model, cage;            ///< absolute; cage may be empty
  std::optional<OpenedSurface> generated_cage;  ///< a cage without a file
  std::filesystem::path origin;                 ///< "session"; absolute; may be empty
  std::optional<std::uint64_t> origin_content;
  std::string first_edit;
  std::uint64_t model_content = 0, cage_content = 0;  ///< 0: not known
  sym3::Method method = sym3::Method::fast;
  deform::Scheme scheme;
  std::vector<MaskRun> mask;  ///< empty: missing
  deform::Probes probes;
  std::optional<CameraPose> camera;  ///< missing: frame the model
  ViewOptions view;
  SideWays sides;
  Handling handling;
  std::optional<glm::ivec2> window;
  ElementKind selecting = ElementKind::vertex;
  std::vector<std::uint32_t> selection;
  CageGroups groups;
  PoseLibrary library;
  Timeline timeline;
  double frame = 1;                   ///< timeline frame
  SharedShape shape{};                ///< null: at rest
  std::optional<deform::Pose> pose;   ///< missing: at rest; NaN: a position that could not be read
  std::vector<std::string> warnings;  ///< one line each, naming file and key, and what is taken instead
};

/// File names relative to the folder of `file`; absolute if `portable` is false. Throws base::Error.
std::string session_text(const Session& session, const std::filesystem::path& file, bool portable = true);

/// Throws base::Error naming file and key. Does not check that the pose fits the cage: see fit_to_cage.
Session read_session(const std::filesystem::path& file);

/// Removes selected elements that do not exist, with a warning.
void fit_selection(Session& session, const Document& document, const std::filesystem::path& file);

/// Sets and hidden vertices, without vertices the cage does not have; a warning lists what is removed.
CageGroups fit_groups(Session& session, const Document& document, const std::filesystem::path& file);

/// Warns if the content of model or cage differs from when the session was saved: the pose may then belong to
/// another cage.
void warn_of_changes(Session& session, const Document& document, const std::filesystem::path& file);

/// Replaces unreadable positions by rest positions, with a warning. Throws base::Error naming `file` and the
/// key if the pose does not fit the cage.
void fit_to_cage(Session& session, const deform::Cage& cage, const std::filesystem::path& file);

/// Removes pins of vertices the model does not have, with a warning.
void fit_pins(Session& session, const mesh::Surface& model, const std::filesystem::path& file);

/// The shape of the model; null, with a warning, unless it has one position per vertex.
SharedShape fit_shape(Session& session, const mesh::Surface& model, const std::filesystem::path& file);

/// The mask of the model; null, with a warning, unless it has one share per vertex.
deform::Mask fit_to_model(Session& session, const mesh::Surface& model, const std::filesystem::path& file);

inline constexpr const char* session_extension = ".viete";
/// By its extension.
bool is_session(const std::filesystem::path& file);

/// Run lengths of a mask; null: every vertex follows the cage.
std::vector<MaskRun> runs_of(const deform::Mask& mask);

/// Checksum of a file; nullopt if it cannot be read.
std::optional<std::uint64_t> content_of(const std::filesystem::path& file);

std::uint64_t content_of_bytes(std::string_view bytes);

}  // namespace viete::scene
