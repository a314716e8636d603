// Reads files that the user opens. workspace/apply_opened.h then applies the result to a workspace.
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

/// Files to use instead of the files in a session. If a path is empty, the session's file is used.
struct LocatedFiles {
  std::filesystem::path model, cage;
};

/// Thrown if the file of a session's model or cage is missing.
struct SessionFileError : base::Error {
  SessionFileError(const std::filesystem::path& session, std::string_view key,
                   const std::filesystem::path& file);
  std::string_view key;  ///< "model" or "cage"
  std::filesystem::path file;
};

struct OpenRequest {
  enum class What {
    model,      ///< a session, or a model with optional cage and pose
    cage,       ///< a cage for the open model
    pose,       ///< a pose for the open cage
    poses,      ///< poses for the open cage, added to the named poses: see read_poses()
    animation,  ///< keys for the open cage; they replace the existing keys: see read_keys()
    shapes,     ///< shapes for the open model, added to the poses: see read_shapes()
    dropped,    ///< files of any kind; the content decides
    recovery    ///< unsaved work
  };
  What what = What::model;
  std::vector<std::filesystem::path> files;
  /// For a model. If settings are missing, the open document or the session gives them.
  document::RequestedSettings settings{};
  LocatedFiles located{};     ///< replacements for the files of a session
  bool without_fins = false;  ///< for What::model and What::cage: removes the fins of the cage
};

/// The result of reading files. apply_opened.h applies it to a workspace.
struct Opened {
  std::optional<document::Document> document;      ///< present if a model, cage or session was opened
  std::optional<deform::Pose> pose;                ///< a new pose of the open cage
  std::vector<document::NamedPose> poses;          ///< poses to add
  std::vector<document::NamedShape> shapes;        ///< shapes to add
  std::vector<document::PoseKey> keys;             ///< keys that replace the existing keys
  std::shared_ptr<const deform::Cage> pose_of;     ///< the cage of pose, poses and keys
  std::shared_ptr<const mesh::Surface> shapes_of;  ///< the model of the shapes; null if there are no shapes
  document::VectorCache vectors;                   ///< log vectors of the shapes
  std::string lost;  ///< names of poses lost with the previous cage: "3 poses and 2 keys"; or empty
  std::optional<Session> session;
  std::filesystem::path file;                  ///< the session, pose or animation
  std::optional<std::uint64_t> content;        ///< checksum of the session file
  bool recovered = false;                      ///< true if the session is unsaved work
  bool has_settings = false;                   ///< true if the session or request has document settings
  std::vector<document::FileInUse> also_read;  ///< files of poses, shapes and keys
  std::vector<std::string> warnings;
  std::string taken_as;  ///< message that says how dropped files were interpreted
};

/// Reads the requested files. current: the open document. Cages, poses, keys and shapes must match this
/// document. progress may be null. Throws base::Cancelled and base::Error (for sessions also
/// SessionFileError, for cages also deform::FinError). Thread-safe.
///
/// The content and number of dropped files decide. A single file is the first of these kinds that matches:
/// - a session, or a point cache: shapes if it matches the model, otherwise keys
/// - a pose with the number of vertices and the faces of the open cage
/// - a shape with the number of vertices and the faces of the open model, but not its file
/// - a cage, if no cage is open and the file encloses the open model with fewer vertices
/// - a model
/// Two files are shapes if they match the open model; otherwise a model and the cage that encloses it. If
/// neither file or each file encloses the other, the cage is the file with fewer vertices. More than two
/// files are shapes.
Opened open_files(const OpenRequest& request, const document::Document& current,
                  base::Progress* progress = nullptr);

/// If opened.document exists, these functions check it. Errors also contain the session's name.
void check_drawable(const Opened& opened);
void check_deformable(const Opened& opened);

/// Returns all files that were read: model, cage and pose with their dependencies, keys, the session.
document::FilesInUse files_of(const Opened& opened);

}  // namespace viete::files
