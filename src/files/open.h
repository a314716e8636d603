// Opening files in two steps: reading, which may take long and runs in the background, and applying the
// result to a workspace, which is immediate: workspace/apply_opened.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "document/animation.h"
#include "document/document.h"
#include "files/session.h"

namespace viete::files {

/// Replacements for the files that a session names; empty: as named.
struct LocatedFiles {
  std::filesystem::path model, cage;
};

/// A model or cage that a session names is missing.
struct SessionFileError : base::Error {
  SessionFileError(const std::filesystem::path& session, std::string_view key,
                   const std::filesystem::path& file);
  std::string_view key;  ///< "model" or "cage"
  std::filesystem::path file;
};

/// Files to open: see open_files().
struct OpenRequest {
  enum class What {
    model,      ///< a session, or a model with optional cage and pose
    cage,       ///< for the open model
    pose,       ///< for the open cage
    poses,      ///< for the open cage, added to the named poses: see read_poses()
    animation,  ///< for the open cage, replacing the existing keys: see read_keys()
    shapes,     ///< for the open model, added to the poses: see read_shapes()
    dropped,    ///< determined from the content
    recovery    ///< unsaved work
  };
  What what = What::model;
  std::vector<std::filesystem::path> files;
  document::RequestedSettings
      settings{};             ///< for a model; unset values come from the open document or the session
  LocatedFiles located{};     ///< for a session
  bool without_fins = false;  ///< for a cage; not for dropped files or a session
};

/// The result of reading files, ready to be applied to a workspace.
struct Opened {
  std::optional<document::Document> document;      ///< another model, another cage, or a session
  std::optional<deform::Pose> pose;                ///< a new pose of the open cage
  std::vector<document::NamedPose> poses;          ///< poses to add
  std::vector<document::NamedShape> shapes;        ///< shapes to add
  std::vector<document::PoseKey> keys;             ///< keys that replace the existing ones
  std::shared_ptr<const deform::Cage> pose_of;     ///< the cage the poses were read for
  std::shared_ptr<const mesh::Surface> shapes_of;  ///< the model the shapes were read for; null: no shapes
  document::VectorCache vectors;                   ///< log vectors of the shapes
  std::string lost;  ///< poses lost with the previous cage: "3 poses and 2 keys"; or empty
  std::optional<Session> session;
  std::filesystem::path file;                  ///< the session, pose or animation
  std::optional<std::uint64_t> content;        ///< checksum of the session file; not for unsaved work
  bool recovered = false;                      ///< the session is unsaved work
  bool has_settings = false;                   ///< document settings from the session or the request
  std::vector<document::FileInUse> also_read;  ///< files of poses and keys
  std::vector<std::string> warnings;
  std::string taken_as;  ///< dropped files: how each was interpreted
};

/// Reads the requested files. `current`, the open document, supplies the model of a requested cage and the
/// cage of a requested pose, and is never changed. progress may be null. Throws base::Error (for sessions
/// also SessionFileError, for cages deform::FinError) and base::Cancelled. Thread-safe.
///
/// Dropped files are identified by content and number. One file: a session; a point cache, as keys or, if it
/// fits the model, as shapes; a pose, if it has the vertex count and faces of the open cage; a shape, if it
/// has those of the open model and is another file; a cage, if none is open and it encloses the open model
/// with fewer vertices; otherwise a model. Two files: a model and its cage, which is the enclosing one, or if
/// neither or both enclose the other, the one with fewer vertices. More files, or two shapes of the open
/// model: shapes.
Opened open_files(const OpenRequest& request, const document::Document& current,
                  base::Progress* progress = nullptr);

/// Check the opened document, if any; errors also name the session.
void check_drawable(const Opened& opened);
void check_deformable(const Opened& opened);

/// All files that were read: model, cage, pose and their dependencies, keys, the session.
document::FilesInUse files_of(const Opened& opened);

}  // namespace viete::files
