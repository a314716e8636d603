// Reads files that the user opens. workspace/open_save.h then applies the result to a workspace.
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

/// Thrown if a session names a model file or a cage file that does not exist.
struct SessionFileError : base::Error {
  SessionFileError(const std::filesystem::path& session, std::string_view key,
                   const std::filesystem::path& file);
  std::string_view key;        ///< "model" or "cage"
  std::filesystem::path file;  ///< the missing file
};

struct OpenRequest {
  enum class What {
    model,      ///< a session, or a model with optional cage and pose
    cage,       ///< a cage for the open model
    pose,       ///< a pose for the open cage
    poses,      ///< poses for the open cage, added to the named poses: see read_poses()
    animation,  ///< keys for the open cage or model, instead of the existing keys: see read_keys()
    shapes,     ///< shapes for the open model, added to the poses: see read_shapes()
    dropped,    ///< files of any kind; the content decides
    recovery    ///< a recovery file with unsaved edits
  };
  What what = What::model;
  std::vector<std::filesystem::path> files;
  /// Settings of the new document. Missing settings come from the session or the open document.
  document::RequestedSettings settings{};
  LocatedFiles located{};     ///< replacements for the files of a session
  bool without_fins = false;  ///< What::model, What::cage: applies cages::without_fins()
};

struct Opened {
  std::optional<document::Document> document;      ///< present if a model, cage or session was opened
  std::optional<pose::Pose> pose;                  ///< a new pose of the open cage
  std::vector<document::NamedPose> poses;          ///< poses to add
  std::vector<document::NamedShape> shapes;        ///< shapes to add
  std::vector<document::PoseKey> keys;             ///< keys that replace the existing keys
  std::shared_ptr<const pose::Cage> pose_of;       ///< the cage of `pose`, `poses` and `keys`
  std::shared_ptr<const mesh::Surface> shapes_of;  ///< the model of the shapes; null if there are no shapes
  document::VectorCache vectors;                   ///< log vectors of the shapes
  std::string lost;  ///< number of poses that do not fit the new cage: "3 poses and 2 keys"; or empty
  std::optional<Session> session;
  std::filesystem::path file;                  ///< the session, pose or animation
  std::optional<std::uint64_t> content;        ///< checksum of the session file
  bool recovered = false;                      ///< true if the session is a recovery file
  bool has_settings = false;                   ///< true if the session or request has document settings
  std::vector<document::FileInUse> also_read;  ///< files of poses, shapes and keys
  std::vector<std::string> warnings;
  std::string taken_as;  ///< message that says how dropped files were interpreted
};

/// Reads the requested files. current: the open document. Cages, poses, keys and shapes must match this
/// document. progress may be null. Throws base::Cancelled and base::Error (for sessions also
/// SessionFileError, for cages also pose::FinError). Thread-safe.
///
/// For What::dropped, the content and number of files decide. A single file is the first matching kind:
/// - a session
/// - a point cache: shapes if the number of points matches the model but not the cage, otherwise keys
/// - a pose, if the file has the number of vertices and the faces of the open cage
/// - a shape, if the file has the vertex count and the faces of the open model, but is not the model's file
/// - a cage, if no cage is open, and the file has fewer vertices than the open model and encloses the model
/// - a model
/// Two files are shapes if both match the open model. Otherwise they are a model and its cage. The cage is
/// the file that encloses the other file. If neither or both enclose the other file, the cage is the file
/// with fewer vertices. More than two files are shapes.
Opened open_files(const OpenRequest& request, const document::Document& current,
                  base::Progress* progress = nullptr);

/// If opened.document exists, these functions check the document. Errors also contain the session's name.
void check_drawable(const Opened& opened);
void check_deformable(const Opened& opened);

/// Returns all files that were read, and the files used by model and cage.
document::FilesInUse files_of(const Opened& opened);

}  // namespace viete::files
