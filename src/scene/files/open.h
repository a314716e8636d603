// Opening files, in two steps: they are read, which may take long and runs aside; then a workspace takes what
// was read, at once: workspace/taking.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "scene/document/animation.h"
#include "scene/document/settings.h"
#include "scene/files/session.h"

namespace viete::scene {

/// Files in place of those that a session names; empty: as it names them.
struct LocatedFiles {
  std::filesystem::path model, cage;
};

/// A model or cage that a session names is not there.
struct SessionFileError : base::Error {
  SessionFileError(const std::filesystem::path& session, std::string_view key,
                   const std::filesystem::path& file);
  std::string_view key;  ///< "model" or "cage"
  std::filesystem::path file;
};

/// Files to be opened: see open_files().
struct OpenRequest {
  enum class What {
    model,      ///< a session, or a model and, where they are named, its cage and a pose
    cage,       ///< of the open model
    pose,       ///< of the open cage
    poses,      ///< likewise, to be added to those with names: see read_poses()
    animation,  ///< likewise, in place of the keys that are there: see read_keys()
    shapes,     ///< of the open model, to be added to the poses: see read_shapes()
    dropped,    ///< whatever they are
    recovery    ///< unsaved work
  };
  What what = What::model;
  std::vector<std::filesystem::path> files;
  AskedSettings settings{};   ///< for a model; the rest is as in what is open now, or as the session has it
  LocatedFiles located{};     ///< for a session
  Fins fins = Fins::refused;  ///< of a cage
};

/// Everything that a file gave, ready to be taken into a workspace.
struct Opened {
  std::optional<Document> document;                ///< another model, another cage, or a session
  std::optional<deform::Pose> pose;                ///< or another pose of the open cage
  std::vector<NamedPose> poses;                    ///< or poses to be added
  std::vector<NamedShape> shapes;                  ///< or shapes to be added
  std::vector<PoseKey> keys;                       ///< or keys in place of those that are there
  std::shared_ptr<const deform::Cage> pose_of;     ///< which was open when these were read
  std::shared_ptr<const mesh::Surface> shapes_of;  ///< likewise; null: there are none among them
  KnownVectors vectors;                            ///< of the shapes that were read
  std::string lost;  ///< poses of the cage before, which go with it: "3 poses and 2 keys"; or empty
  std::optional<Session> session;
  std::filesystem::path file;            ///< the session, pose or animation
  std::optional<std::uint64_t> content;  ///< checksum of the session file; of unsaved work nothing
  bool recovered = false;                ///< the session is unsaved work
  bool has_settings = false;             ///< of the document: from the session, or asked for
  std::vector<FileInUse> also_read;      ///< files of poses and keys
  std::vector<std::string> warnings;
  std::string taken_as;  ///< of dropped files: which was taken as what
};

/// Reads what is asked for. `current` is what is open now: a cage needs its model, a pose its cage; it is not
/// changed, so that whatever goes wrong leaves everything as it was. progress may be null. Throws base::Error
/// (of a session also SessionFileError) and base::Cancelled. Thread-safe.
///
/// Dropped files are judged by content and count. One: a session; a point cache, as keys or, if it is of the
/// model, as shapes; a pose, if it has as many vertices as the open cage and the same faces; a shape, if it
/// has those of the open model and is another file; a cage, if none is open and it encloses the open model
/// with fewer vertices; else a model. Two: a model and its cage, which is the one that encloses the other; if
/// neither does, or both, the one with fewer vertices. More, or two that are shapes of the open model:
/// shapes.
Opened open_files(const OpenRequest& request, const Document& current, base::Progress* progress = nullptr);

/// Those of its document, if there is one; of a session the error names the session too.
void check_drawable(const Opened& opened);
void check_deformable(const Opened& opened);

/// All that was read to open it: model, cage, pose and what these lead to, keys, the session.
FilesInUse files_of(const Opened& opened);

}  // namespace viete::scene
