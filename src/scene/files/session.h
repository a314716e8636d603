// A session: everything that makes the picture, as a readable file that leads back to it.
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

/// Vertices one after the other with the same share, in 255ths.
struct MaskRun {
  std::uint32_t share, vertices;

  friend bool operator==(const MaskRun&, const MaskRun&) = default;
};

/// The contents of a session file. JSON:
///   "format": "viete session", "version": 1,
///   "model", "cage"       file names, relative to the session's folder; no cage: the key is missing; names
///                         that are not UTF-8 as path_json() writes them
///   "made_cage"           instead of "cage", one that is in no file: "name", "positions": [x, y, z] a
///   vertex,
///                         "polygons": indices of its corners, from 0
///   "model_content", "cage_content"   mesh::content_key() of what they were, 16 hexadecimal digits
///   "session"             only in recovered work: the session file that it belongs to
///   "session_content"     likewise: checksum of that file as it was then, 16 hexadecimal digits
///   "first_edit"          likewise: what was done first since that was saved, for people
///   "method"              "diag", "sd", "improved_sd" or "fast"
///   "weights", "blend"   names of deform/scheme.h; missing: what fits the others
///   "turn", "stretch"     how much of maps' rotations and stretches acts, percent, 0 to 200; missing: 100
///   "stitched"            how often a stitched model is solved for, 1 to 20; missing: it is not stitched
///   "pins", "hold"        of stitched models, percent, 0 to 100, see deform::Holding; missing: 0
///   "radius"              of cut-off weights, percent of the cage's size; missing: 25
///   "mask"                painted shares of the model's vertices in their order, in 255ths: [share, for how
///                         many vertices, share, ...]; missing: every vertex follows the cage
///   "probes"              see session_parts.h; missing: there are none
///   "camera"              see camera_json.h
///   "view"                flags, see ViewOptions
///   "views"               those beside the first: [{"method", what says a scheme, "field": the map,
///                         "other_lines": straight where the first has logs}], 3 at most; missing: none
///   "wipe"                of two views, where the line between them is, 0.05 to 0.95; missing: side by side
///   "cameras"             as "camera", one of each of "views", where they are not linked; missing: they are
///   "hand"                see session_parts.h; missing: as in a new window
///   "window"              [width, height] in logical pixels
///   "selecting"           "vertices", "edges" or "faces" of the cage, or "probes"
///   "selection"           their indices, from 0
///   "sets"                vertices of the cage by name: [{"name", "selecting": what they are selected as,
///                         "vertices": their indices, from 0}]; missing: there are none
///   "hidden"              vertices of the cage that are not shown; missing: none
///   "pose"                "turns": rotation vectors in radians, one per part of the cage;
///                         "positions": [x, y, z] per cage vertex
///   "poses", "time"       those with names, and keys: see pose_json.h; missing: there are none
///   "unmixed"             while poses are mixed: what is there without them
///   "shapes"              of the model, which poses and keys name by their numbers: see pose_json.h;
///   missing:
///                         there are none
///   "shape"               the number of the one that the model has; missing: it is at rest
/// Only format, version and model are required. Unknown keys are ignored, so that newer programs may add
/// some. Ranges are those of scene/document/range.h. What is damaged beside model, cage and the list of
/// positions costs its own part: it counts as missing, and a warning says so.
struct Session {
  std::filesystem::path model, cage;       ///< absolute; cage may be empty
  std::optional<OpenedSurface> made_cage;  ///< that is in no file
  std::filesystem::path origin;            ///< "session"; absolute; may be empty
  std::optional<std::uint64_t> origin_content;
  std::string first_edit;
  std::uint64_t model_content = 0, cage_content = 0;  ///< 0: not known
  sym3::Method method = sym3::Method::fast;
  deform::Scheme scheme;
  std::vector<MaskRun> mask;  ///< empty: missing
  deform::Probes probes;
  std::optional<CameraPose> camera;  ///< missing: the model is framed
  ViewOptions view;
  SideWays sides;
  Handling handling;
  std::optional<glm::ivec2> window;
  ElementKind selecting = ElementKind::vertex;
  std::vector<std::uint32_t> selection;
  CageGroups groups;
  PoseLibrary library;
  Timeline timeline;
  double frame = 1;                   ///< of the timeline
  SharedShape shape{};                ///< null: at rest
  std::optional<deform::Pose> pose;   ///< missing: at rest; NaN: a position that could not be read
  std::vector<std::string> warnings;  ///< one line each, naming file and key, and what is taken instead
};

/// File names relative to the folder of `file`; absolute with `portable` false. Throws base::Error.
std::string session_text(const Session& session, const std::filesystem::path& file, bool portable = true);

/// Throws base::Error naming file and key. Whether the pose fits the cage is not known here: see
/// fit_to_cage.
Session read_session(const std::filesystem::path& file);

/// What is selected is dropped where there is no such element, with a warning.
void fit_selection(Session& session, const Document& document, const std::filesystem::path& file);

/// Sets and what is hidden, as far as the cage has such vertices; a warning names what is dropped.
CageGroups fit_groups(Session& session, const Document& document, const std::filesystem::path& file);

/// A warning if the content of model or cage is another than when the session was saved: then the pose may be
/// that of another cage.
void tell_what_changed(Session& session, const Document& document, const std::filesystem::path& file);

/// Positions that could not be read become those at rest, with a warning. Throws base::Error naming `file`
/// and the key if the pose cannot be of this cage.
void fit_to_cage(Session& session, const deform::Cage& cage, const std::filesystem::path& file);

/// Pins of vertices that the model has not are dropped, with a warning.
void fit_pins(Session& session, const mesh::Surface& model, const std::filesystem::path& file);

/// The shape of the model. One that has not a place for each vertex is dropped, with a warning.
SharedShape fit_shape(Session& session, const mesh::Surface& model, const std::filesystem::path& file);

/// The mask of the model. One that has not a share for each vertex is dropped, with a warning.
deform::Mask fit_to_model(Session& session, const mesh::Surface& model, const std::filesystem::path& file);

inline constexpr const char* session_extension = ".viete";
/// By its extension.
bool is_session(const std::filesystem::path& file);

/// A mask as a session has it; null: every vertex follows the cage.
std::vector<MaskRun> runs_of(const deform::Mask& mask);

/// Checksum of a file; nothing if it cannot be read.
std::optional<std::uint64_t> content_of(const std::filesystem::path& file);

std::uint64_t content_of_bytes(std::string_view bytes);

}  // namespace viete::scene
