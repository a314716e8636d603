#include "workspace/apply_opened.h"

#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "document/camera.h"
#include "document/document.h"
#include "document/edit.h"
#include "document/elements.h"
#include "document/pose_edit.h"
#include "files/animation_import.h"
#include "workspace/playing.h"
#include "workspace/saving.h"

namespace viete::workspace {

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
