#include "workspace/saving.h"

#include <algorithm>

#include "base/atomic_file.h"
#include "document/brush.h"
#include "document/pose_edit.h"
#include "files/output.h"
#include "formats/format_table.h"
#include "formats/write.h"
#include "pose/cage.h"
#include "workspace/playing.h"
#include "workspace/split.h"

namespace viete::workspace {

namespace fs = std::filesystem;

namespace {

// Calls step() to write `path`. Fails if `path` is an open file other than `own`. Shows success or the error.
template <class Step>
bool attempt(Workspace& w, const char* what, const fs::path& path, std::string_view own, Step step) {
  const std::string topic = std::string("save ") + what;
  try {
    const bool session = own == document::the_session;
    const bool anew = session && path == w.files.saved.session;  // a session may overwrite its own file
    check_output(path, session ? files::Content::session : files::Content::surface, files_open(w, own),
                 anew ? files::Force::given : files::Force::none);
    step();
    w.messages.succeeded(topic);
    w.messages.info("Saved " + path.filename().string() + ".");
    return true;
  } catch (const std::exception& error) {
    report_refusal(w, path, base::message_of(error), topic);
    return false;
  }
}

// True if the pose comes from the keys at this frame. Such a pose need not be saved.
bool is_timeline_pose(const Workspace& w) {
  return w.document.timeline().has_poses() && !is_editing_cage(w.document) && !has_unkeyed_pose(w);
}

// True if the probes equal the saved probes. If `by_time`, ignores poses of unlocked probes: keys set them.
bool same_probes(const Workspace& w, const document::DocumentState& saved, bool by_time) {
  pose::Probes now = w.document.probes();
  for (std::size_t i = 0; by_time && i < std::min(now.all.size(), saved.probes.all.size()); ++i)
    if (!now.all[i].locked) now.all[i].pose = saved.probes.all[i].pose;
  return now == saved.probes;
}

// True if the named poses equal the saved ones. If `by_time`, ignores weights: another frame clears them.
bool same_library(const Workspace& w, const document::PoseLibrary& saved, bool by_time) {
  document::PoseLibrary now = w.document.library();
  for (std::size_t i = 0; by_time && i < std::min(now.poses.size(), saved.poses.size()); ++i)
    now.poses[i].weight = saved.poses[i].weight;
  return now == saved;
}

// True if the timeline is saved. An unkeyed pose can be saved in Timeline::unkeyed or as the document's pose.
bool same_timeline(const Workspace& w, const document::DocumentState& saved) {
  document::Timeline now = w.document.timeline();
  if (now == saved.timeline) return true;
  const auto is_saved = [&](const document::PoseKey& left) {
    const auto is_same = [&](const document::PoseKey& key) { return *key.pose == *left.pose; };
    const auto same_probe = [](const pose::ProbePose& pose, const pose::Probe& probe) {
      return probe.locked || pose == probe.pose;
    };
    return std::ranges::any_of(saved.timeline.unkeyed, is_same) ||
           (document::same_shape(left.pose->shape, saved.shape) &&
            document::same_pose(left.pose->cage, saved.pose) &&
            std::ranges::equal(left.pose->probes, saved.probes.all, same_probe));
  };
  const bool all_saved = std::ranges::all_of(now.unkeyed, is_saved);
  now.unkeyed = saved.timeline.unkeyed;
  return all_saved && now == saved.timeline;
}

}  // namespace

bool save_session(Workspace& w, const fs::path& path) {
  return attempt(w, "session", path, document::the_session, [&] {
    const std::string text = session_text(session_of(w), path);
    base::replace_file(path, text);
    w.files.saved.session = path;
    w.files.saved.content = files::content_of_bytes(text);
    w.preferences.add({path, {}});
    mark_saved(w);
  });
}

bool save_pose(Workspace& w, const fs::path& path) {
  return attempt(w, "pose", path, document::the_pose, [&] {
    pose::write_pose(path, *w.document.cage(), real_pose(w.document));
    mark_pose_saved(w);
  });
}

bool save_cage(Workspace& w, const fs::path& path) {
  document::Document& document = w.document;
  return attempt(w, "cage", path, document::the_cage, [&] {
    formats::check_keeps_vertices(path);  // poses and sessions depend on the vertex order
    formats::write(path, document.cage()->surface, {"cage of " + document.model().path.filename().string()});
    document.changed_history().file_replaced(path, document.cage());
    document.put_saved_cage(path);
    w.files.saved.put_cage(document.cage());
  });
}

namespace {

bool is_moved(const document::OpenedSurface& mesh) {
  std::error_code ignored;
  return mesh.surface && !mesh.path.empty() && !fs::exists(mesh.path, ignored);
}

// A free name beside a session, in a format that keeps the order of the vertices.
fs::path name_beside(const fs::path& session, const document::OpenedSurface& mesh, bool rewrites) {
  fs::path file = session.parent_path() / mesh.path.filename();
  const bool keeps = formats::is_a(formats::keeps_order, file) ||
                     (rewrites && formats::writes_itself(mesh.original.get(), file));
  return base::unused_name(keeps ? file : file.replace_extension("ply"));
}

}  // namespace

std::string moved_files(const Workspace& w) {
  std::string names = is_moved(w.document.model()) ? name_of(w.document.model()) : "";
  if (is_moved(w.document.cage_file()))
    names += (names.empty() ? "" : " and ") + name_of(w.document.cage_file());
  return names;
}

bool save_moved_files(Workspace& w, const fs::path& session) {
  const document::OpenedSurface& model = w.document.model();
  const document::OpenedSurface& cage = w.document.cage_file();
  if (is_moved(cage) && !save_cage(w, name_beside(session, cage, false))) return false;
  if (!is_moved(model)) return true;
  const fs::path file = name_beside(session, model, true);
  return attempt(w, "model", file, document::the_model, [&] {
    const formats::Content content{
        *model.surface, model.surface->positions, {}, model.attributes.get(), model.splats.get()};
    for (const std::string& note : formats::write(file, content, model.original.get(), {}))
      w.messages.log(Severity::warning, note);
    w.document.put_saved_model(file);
  });
}

void report_refusal(Workspace& w, const fs::path& file, const std::string& problem, std::string_view topic) {
  if (!refuse(w.files.browser, file, problem)) w.messages.error(problem, {topic});
}

bool changed_on_disk(const Workspace& w, const fs::path& session) {
  std::error_code ignored;
  return session == w.files.saved.session && w.files.saved.content && fs::exists(session, ignored) &&
         files::content_of(session) != w.files.saved.content;
}

std::string window_title(const Workspace& w) {
  if (!w.document.model().surface) return "Viete";
  return name_of_work(w) + (has_unsaved_edits(w) ? "*" : "") + " - Viete";
}

bool has_unsaved_edits(const Workspace& w) {
  return w.files.saved.recovered || differs(w, w.files.saved.state);
}

bool differs(const Workspace& w, const document::DocumentState& saved) {
  const bool by_time = is_timeline_pose(w);
  if (w.document.cage() != saved.cage || !same_probes(w, saved, by_time) ||
      w.document.groups().sets != saved.groups.sets || !same_library(w, saved.library, by_time) ||
      !same_timeline(w, saved) || !document::same_mask(w.document.mask(), saved.mask))
    return true;
  return w.document.is_movable() && (w.document.deformer() != saved.deformer ||
                                     (!by_time && (!document::same_shape(w.document.shape(), saved.shape) ||
                                                   !document::same_pose(real_pose(w.document), saved.pose))));
}

void mark_saved(Workspace& w) {
  w.files.saved.state = w.document.state();
  mark_pose_saved(w);
}

// Does not include probes, because a pose file contains no probes.
void mark_pose_saved(Workspace& w) {
  w.files.saved.put_pose(real_pose(w.document));
}

files::Session session_of(const Workspace& w) {
  files::Session session;
  static_cast<document::DocumentState&>(session) = w.document.state();
  session.pose = real_pose(w.document);
  session.source.base = unmixed_pose(w.document);
  session.model = w.document.model();
  session.origin = w.files.saved.session;
  session.origin_content = w.files.saved.content;
  session.method = w.document.method();
  session.camera = last_camera_of(w, 0);
  session.view = w.view.options;
  session.sides = side_views(w);
  session.handling = w.view.handling;
  if (document::is_window(w.view.viewport.window.x, w.view.viewport.window.y))
    session.window = glm::ivec2(w.view.viewport.window);
  return session;
}

document::FilesInUse files_open(const Workspace& w, std::string_view own) {
  document::FilesInUse files;
  files::add_document(files, w.document, own);
  if (own != document::the_session) files.add(w.files.saved.session, document::the_session);
  files.add(w.recovery.from, "unsaved work");
  return files;
}

std::string name_of_work(const Workspace& w) {
  return (w.files.saved.session.empty() ? w.document.model().path : w.files.saved.session)
      .filename()
      .string();
}

}  // namespace viete::workspace
