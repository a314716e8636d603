#include "workspace/open_save.h"

#include <algorithm>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/text.h"
#include "document/brush.h"
#include "document/camera.h"
#include "document/document.h"
#include "document/elements.h"
#include "document/pose_edit.h"
#include "files/animation_import.h"
#include "files/output.h"
#include "formats/format_table.h"
#include "formats/write.h"
#include "pose/pose_file.h"
#include "workspace/playing.h"
#include "workspace/time_view.h"

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
  if (document::is_window(w.view.camera.viewport.window.x, w.view.camera.viewport.window.y))
    session.window = glm::ivec2(w.view.camera.viewport.window);
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

namespace {

void report(Workspace& w, const files::Opened& opened) {
  const bool same_model = opened.document && opened.document->model().surface == w.document.model().surface;
  const Concern concern{.scope = same_model || !opened.document ? Scope::cage : Scope::model};
  w.messages.succeeded("open");
  if (!opened.taken_as.empty()) w.messages.info(opened.taken_as, concern);
  for (const auto& warning : opened.warnings) w.messages.warn(warning, concern);
}

// Warns that sets and poses of the previous cage were removed. If `in_file`, the session still contains them.
void report_losses(Workspace& w, const std::string& poses, bool in_file) {
  const std::string file = w.files.saved.session.filename().string();
  const std::string where = in_file && !file.empty() ? "; " + file + " still contains them" : "";
  const Concern concern{.scope = Scope::cage};
  if (const std::string sets = lost_sets(w.document.groups(), {}); !sets.empty())
    w.messages.warn("Selection sets of the previous cage were removed: " + sets + where, concern);
  if (!poses.empty()) w.messages.warn("Poses of the previous cage were removed: " + poses + where, concern);
}

void take_document(Workspace& w, document::Document&& document, bool keep_settings) {
  const document::Document& old = w.document;
  if (keep_settings) {
    document.put_method(old.method());
    document.put_deformer(old.deformer());
  }
  document.mark_replacing(old);
  w.document = std::move(document);
  w.view.interaction = {};
  w.making = {.wish = w.making.wish};
  w.playback = {.auto_key = w.playback.auto_key, .vectors = std::move(w.playback.vectors)};
  w.view.chosen_pose.reset();
  w.view.time = {};
  w.panels.offer_cage = true;
  w.frame.methods = {};
  w.view.split.views[0] = {};
  w.view.split.before.reset();
  w.view.vertex = {};
  forget_findings(w.checks);
  ++w.files.opened;
}

// Hidden hints stay hidden, even if the session shows hints.
void take_view(Workspace& w, const files::Session& session) {
  const bool hints = w.view.options.hints;
  w.view.options = session.view;
  put_side_views(w.view.split, session.sides);
  w.view.options.hints = hints && session.view.hints;
}

// Takes the session's transform settings. Without a session, a new model resets the placed pivot and mirror.
void take_handling(Workspace& w, const files::Opened& opened, bool same_model) {
  if (opened.session) {
    w.view.handling = opened.session->handling;
  } else if (!same_model) {
    w.view.handling.point.reset();
    w.view.handling.mirror = document::MirrorPlane::none;
    if (w.view.handling.pivot == document::Pivot::point) w.view.handling.pivot = document::Pivot::median;
  }
}

// Adds opened poses, shapes or keys to the document as one edit. If there are none, returns false.
bool take_poses(Workspace& w, files::Opened& opened) {
  const std::string name = opened.file.filename().string();
  const auto add = [&](const auto& put, const std::string& done) {
    try {
      put();
      w.messages.info("Added " + done);
    } catch (const base::Error& error) {
      w.messages.error(error.what(), {"open"});
    }
    return true;
  };
  if (!opened.poses.empty())
    return add([&] { add_poses(w.document, std::move(opened.poses)); },
               base::counted(opened.poses.size(), "pose") + " from " + name + ".");
  if (!opened.shapes.empty())
    return add([&] { add_shapes(w.document, std::move(opened.shapes)); },
               base::counted(opened.shapes.size(), "shape") + " to the poses.");
  if (opened.keys.empty()) return false;
  const std::size_t count = opened.keys.size(), before = w.document.timeline().keys.size();
  files::put_keys(w.document, std::move(opened.keys), "Import animation");
  show_timeline(w);
  w.messages.info("Imported " + base::counted(count, "key") + " from " + name +
                  (before > 0 ? "; undo restores the previous " + std::to_string(before) + "." : "."));
  return true;
}

void take_pose(Workspace& w, pose::Pose&& pose) {
  const bool was_saved = !has_unsaved_edits(w);
  replace_pose(w, [&] { set_pose(w.document, std::move(pose)); });
  if (was_saved) mark_pose_saved(w);  // the opened file contains the pose
}

// If the model or cage is flat, looks along the flat axis without perspective. Otherwise uses the home view.
void frame_first(Workspace& w) {
  const mesh::Bounds box = w.document.has_cage() ? w.document.cage_file().bounds : w.document.model().bounds;
  const bool z_up = w.view.camera.pose().up == document::UpAxis::z;
  const document::StandardView along[] = {document::StandardView::right,
                                          z_up ? document::StandardView::front : document::StandardView::top,
                                          z_up ? document::StandardView::top : document::StandardView::front};
  for (std::size_t k = 0; k < 3; ++k) {
    if (box.high[k] - box.low[k] > 1e-9 * box.diagonal()) continue;
    w.view.camera.look(along[k]);
    return w.view.camera.set_orthographic(true);
  }
  w.view.camera.look(document::StandardView::home);
}

}  // namespace

void apply_opened(Workspace& w, files::Opened&& opened) {
  if (opened.pose_of && opened.pose_of != w.document.cage())
    return w.messages.error(
        opened.file.string() + ": the cage changed while this pose was being read; open it again", {"open"});
  if (!opened.document && opened.shapes_of && opened.shapes_of != w.document.model().surface)
    return w.messages.error(
        opened.file.string() + ": the model changed while this shape was being read; open it again",
        {"open"});
  report(w, opened);
  if (opened.shapes_of) {
    w.playback.vectors.follow_model(opened.shapes_of);
    w.playback.vectors.take(std::move(opened.vectors));
  }
  w.document.changed_also_read().insert(w.document.also_read().end(), opened.also_read.begin(),
                                        opened.also_read.end());
  if (take_poses(w, opened)) return;
  if (opened.pose) return take_pose(w, std::move(*opened.pose));
  const bool same_model = opened.document->model().surface == w.document.model().surface;
  if (same_model && !opened.session) report_losses(w, opened.lost, !has_unsaved_edits(w));
  take_document(w, std::move(*opened.document), !opened.has_settings);
  auto& saved = w.files.saved;
  saved.reset();
  w.recovery.from.clear();
  const bool is_example = opened.session && opened.file == w.files.example;
  if (opened.session) {
    take_view(w, *opened.session);
    if (!is_example) {  // for the example, Save must ask for a name
      saved.session = opened.recovered ? opened.session->origin : opened.file;
      saved.content = opened.recovered ? opened.session->origin_content : opened.content;
    }
  }
  take_handling(w, opened, same_model);
  saved.recovered = opened.recovered;
  if (opened.recovered) {
    w.recovery.from = opened.file;
    w.recovery.offered = false;
    std::erase_if(w.recovery.files,
                  [&](const files::RecoveryFile& leftover) { return leftover.file == opened.file; });
  } else {
    mark_saved(w);
    if (opened.session)
      saved.state.deformer = opened.session->deformer;  // settings of the request are unsaved
    if (!opened.session) {                              // no file contains mask and probes
      saved.state.mask = nullptr;
      saved.state.probes = {};
    }
    w.preferences.add(saved.session.empty() ? RecentFile{w.document.model().path, w.document.cage_file().path}
                                            : RecentFile{saved.session, {}});
  }
  add_unkeyed_to_undo(w, opened.recovered);
  if (is_example) show_timeline(w);
  if (is_example && w.panels.has_user) start_playing(w);
  if (opened.session && opened.session->camera) return w.view.camera.set_pose(*opened.session->camera);
  if (same_model) return frame_other_cage(w);
  w.view.camera.set_up(guessed_up(w.document.model()));
  frame_first(w);
  frame_all(w, false);
}

}  // namespace viete::workspace
