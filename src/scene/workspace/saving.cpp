#include "scene/workspace/saving.h"

#include <algorithm>
#include <utility>

#include "base/atomic_file.h"
#include "deform/pose_io.h"
#include "mesh/formats/write.h"
#include "scene/document/brush.h"
#include "scene/document/pose_edit.h"
#include "scene/files/animation_import.h"
#include "scene/files/output.h"
#include "scene/files/session.h"
#include "scene/workspace/playing.h"
#include "scene/workspace/split.h"

namespace viete::scene {

namespace fs = std::filesystem;

namespace {

// Runs a writing step if the file may be written, including `own`, its source. Reports errors as messages.
template <class Step>
bool attempt(Workspace& workspace, const char* what, const fs::path& path, std::string_view own, Step step) {
  const std::string topic = std::string("save ") + what;
  try {
    const bool session = own == the_session;
    const bool anew = session && path == workspace.saved.session;  // in any state
    check_output(path, session ? Content::session : Content::surface, files_open(workspace, own),
                 anew ? Force::given : Force::none);
    step();
    workspace.messages.succeeded(topic);
    workspace.messages.info("Saved " + path.filename().string() + ".");
    return true;
  } catch (const std::exception& error) {
    report_refusal(workspace, path, error.what(), topic);
    return false;
  }
}

// True if the pose is that of the keys at this frame: playback changes nothing worth saving.
bool is_timeline_pose(const Workspace& w) {
  return !w.document.timeline.keys.empty() && !is_editing_cage(w.document) && !has_unkeyed_pose(w);
}

// Or they differ only in their poses, which come from the keys.
bool same_probes(const Workspace& w, bool by_time) {
  deform::Probes now = w.document.probes;
  const auto& saved = w.saved.state.probes.all;
  for (std::size_t i = 0; by_time && i < std::min(now.all.size(), saved.size()); ++i)
    if (!now.all[i].locked) now.all[i].pose = saved[i].pose;
  return now == w.saved.state.probes;
}

// An unkeyed pose is saved in the stored list, or as the stored pose.
bool same_timeline(const Workspace& w) {
  Timeline now = w.document.timeline;
  if (now == w.saved.state.timeline) return true;
  const auto is_saved = [&](const PoseKey& left) {
    const auto is_same = [&](const PoseKey& saved) { return *saved.pose == *left.pose; };
    const auto same_probe = [](const deform::ProbePose& pose, const deform::Probe& probe) {
      return probe.locked || pose == probe.pose;
    };
    return std::ranges::any_of(w.saved.state.timeline.unkeyed, is_same) ||
           (same_shape(left.pose->shape, w.saved.state.shape) &&
            same_pose(left.pose->cage, w.saved.state.pose) &&
            std::ranges::equal(left.pose->probes, w.saved.state.probes.all, same_probe));
  };
  const bool all_saved = std::ranges::all_of(now.unkeyed, is_saved);
  now.unkeyed = w.saved.state.timeline.unkeyed;
  return all_saved && now == w.saved.state.timeline;
}

}  // namespace

bool save_session(Workspace& workspace, const fs::path& path) {
  return attempt(workspace, "session", path, the_session, [&] {
    const std::string text = session_text(session_of(workspace), path);
    base::replace_file(path, text);
    workspace.saved.session = path;
    workspace.saved.content = content_of_bytes(text);
    workspace.preferences.add({path, {}});
    mark_saved(workspace);
  });
}

bool save_pose(Workspace& workspace, const fs::path& path) {
  return attempt(workspace, "pose", path, the_pose, [&] {
    deform::write_pose(path, *workspace.document.cage, real_pose(workspace.document));
    mark_pose_saved(workspace);
  });
}

bool save_chosen_pose(Workspace& workspace, const fs::path& path) {
  return attempt(workspace, "pose", path, no_own,
                 [&] { write_named_pose(workspace.document, *workspace.chosen_pose, path); });
}

bool save_cage(Workspace& workspace, const fs::path& path) {
  Document& document = workspace.document;
  return attempt(workspace, "cage", path, the_cage, [&] {
    mesh::check_keeps_vertices(path);  // poses and sessions depend on the vertex order
    mesh::write(path, document.cage->surface, {"cage of " + document.model.path.filename().string()});
    document.history.file_replaced(path, document.cage);
    document.cage_file.path = path;
    document.cage_file.made.clear();
    document.cage_file.format = "saved here";
    workspace.saved.put_cage(document.cage);
  });
}

void report_refusal(Workspace& workspace, const fs::path& file, const std::string& problem,
                    std::string_view topic) {
  if (!refuse(workspace.browser, file, problem)) workspace.messages.error(problem, {topic});
}

bool changed_on_disk(const Workspace& w, const fs::path& session) {
  std::error_code ignored;
  return session == w.saved.session && w.saved.content && fs::exists(session, ignored) &&
         content_of(session) != w.saved.content;
}

std::string window_title(const Workspace& w) {
  if (!w.document.model.surface) return "Viete";
  const fs::path& file = w.saved.session.empty() ? w.document.model.path : w.saved.session;
  return file.filename().string() + (has_unsaved_edits(w) ? "*" : "") + " - Viete";
}

bool has_unsaved_edits(const Workspace& w) {
  const bool by_time = is_timeline_pose(w);
  if (w.saved.recovered || w.document.cage != w.saved.state.cage || !same_probes(w, by_time) ||
      w.document.groups.sets != w.saved.state.groups.sets || w.document.library != w.saved.state.library ||
      !same_timeline(w) || !same_mask(w.document.mask, w.saved.state.mask))
    return true;
  return w.document.is_movable() && (w.document.scheme != w.saved.state.scheme ||
                                     (!by_time && (!same_shape(w.document.shape, w.saved.state.shape) ||
                                                   !same_pose(real_pose(w.document), w.saved.state.pose))));
}

void mark_saved(Workspace& workspace) {
  workspace.saved.state = state_of(workspace.document);
  mark_pose_saved(workspace);
}

// Not for probes: the file of a pose does not include them.
void mark_pose_saved(Workspace& workspace) {
  workspace.saved.put_pose(real_pose(workspace.document));
}

Session session_of(const Workspace& w) {
  Session session;
  static_cast<DocumentState&>(session) = state_of(w.document);
  session.pose = real_pose(w.document);
  session.library.unmixed = unmixed_pose(w.document);
  session.model = w.document.model;
  session.origin = w.saved.session;
  session.origin_content = w.saved.content;
  session.method = w.document.method;
  session.camera = last_camera_of(w, 0);
  session.view = w.view;
  session.sides = ways_of(w);
  session.handling = w.handling;
  if (is_window(w.viewport.window.x, w.viewport.window.y)) session.window = glm::ivec2(w.viewport.window);
  return session;
}

FilesInUse files_open(const Workspace& w, std::string_view own) {
  FilesInUse files;
  add_document(files, w.document, own);
  if (own != the_session) files.add(w.saved.session, the_session);
  files.add(w.recovered_from, "unsaved work");
  return files;
}

std::string name_of_work(const Workspace& w) {
  return (w.saved.session.empty() ? w.document.model.path : w.saved.session).filename().string();
}

}  // namespace viete::scene
