#include "scene/saving.h"

#include <algorithm>
#include <utility>

#include "base/atomic_file.h"
#include "base/checksum.h"
#include "deform/pose_io.h"
#include "mesh/source.h"
#include "mesh/write.h"
#include "scene/animation_import.h"
#include "scene/brush.h"
#include "scene/cage_editing.h"
#include "scene/output.h"
#include "scene/session.h"

namespace viete::scene {

namespace fs = std::filesystem;

namespace {

// Runs a step that writes where it may: over `own`, what this was read as, too. What goes wrong becomes a
// message.
template <class Step>
bool attempt(Workspace& workspace, const char* what, const fs::path& path, std::string_view own, Step step) {
  const std::string topic = std::string("save ") + what;
  try {
    const bool session = own == the_session;
    const bool anew = session && path == workspace.saved.session;  // whatever has become of it
    check_output(path, session ? Content::session : Content::surface, files_open(workspace, own),
                 anew ? Force::given : Force::none);
    step();
    workspace.messages.succeeded(topic);
    workspace.messages.info(std::string("Saved the ") + what + " to " + path.string());
    return true;
  } catch (const std::exception& error) {
    workspace.messages.error(error.what(), {topic});
    return false;
  }
}

std::uint64_t checksum(std::string_view bytes) {
  base::Checksum sum;
  sum.add(bytes.data(), bytes.size());
  return sum.value();
}

}  // namespace

namespace {

// What is there is as the keys have it at this frame: playing is no work that could be lost.
bool is_by_time(const Workspace& w) {
  return !w.document.timeline.keys.empty() && !is_editing_cage(w.document) && !has_unkeyed_pose(w);
}

// Or differ in their poses alone, and these are by time.
bool same_probes(const Workspace& w, bool by_time) {
  deform::Probes now = w.document.probes;
  const auto& saved = w.saved.probes.all;
  for (std::size_t i = 0; by_time && i < std::min(now.all.size(), saved.size()); ++i)
    if (!now.all[i].locked) now.all[i].pose = saved[i].pose;
  return now == w.saved.probes;
}

// A pose in no key is safe in the list that was saved, and as the pose that was.
bool same_timeline(const Workspace& w) {
  Timeline now = w.document.timeline;
  if (now == w.saved.timeline) return true;
  const auto is_saved = [&](const PoseKey& left) {
    const auto is_same = [&](const PoseKey& saved) { return *saved.pose == *left.pose; };
    const auto same_probe = [](const deform::ProbePose& pose, const deform::Probe& probe) {
      return probe.locked || pose == probe.pose;
    };
    return std::ranges::any_of(w.saved.timeline.unkeyed, is_same) ||
           (same_pose(left.pose->cage, w.saved.pose) &&
            std::ranges::equal(left.pose->probes, w.saved.probes.all, same_probe));
  };
  const bool all_saved = std::ranges::all_of(now.unkeyed, is_saved);
  now.unkeyed = w.saved.timeline.unkeyed;
  return all_saved && now == w.saved.timeline;
}

}  // namespace

bool save_session(Workspace& workspace, const fs::path& path) {
  return attempt(workspace, "session", path, the_session, [&] {
    const std::string text = session_text(session_of(workspace), path);
    base::replace_file(path, text);
    workspace.saved.session = path;
    workspace.saved.content = checksum(text);
    workspace.remembered.add({path, {}});
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
    mesh::check_keeps_vertices(path);  // which poses, and the session, go by
    mesh::write(path, document.cage->surface, {"cage of " + document.model.path.filename().string()});
    document.history.file_replaced(path, document.cage);
    document.cage_file.path = path;
    document.cage_file.made.clear();
    document.cage_file.format = "saved here";
    workspace.saved.cage = document.cage;
    ++workspace.saved.revision;
  });
}

bool changed_on_disk(const Workspace& w, const fs::path& session) {
  std::error_code ignored;
  return session == w.saved.session && w.saved.content && fs::exists(session, ignored) &&
         content_of(session) != w.saved.content;
}

std::optional<std::uint64_t> content_of(const fs::path& file) {
  try {
    return checksum(mesh::FileBytes(file, nullptr).view());
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::string window_title(const Workspace& w) {
  if (!w.document.model.surface) return "Viete";
  const fs::path& file = w.saved.session.empty() ? w.document.model.path : w.saved.session;
  return file.filename().string() + (has_unsaved_edits(w) ? "*" : "") + " - Viete";
}

bool has_unsaved_edits(const Workspace& w) {
  const bool by_time = is_by_time(w);
  if (w.saved.nowhere || w.document.cage != w.saved.cage || !same_probes(w, by_time) ||
      w.document.groups.sets != w.saved.sets || w.document.library != w.saved.library || !same_timeline(w) ||
      !same_mask(w.document.mask, w.saved.mask))
    return true;
  return w.document.is_movable() && (w.document.scheme != w.saved.scheme ||
                                     (!by_time && !same_pose(real_pose(w.document), w.saved.pose)));
}

void mark_edits_saved(Workspace& workspace, const std::string& first_edit) {
  workspace.saved.edits = workspace.document.history.recorded();
  workspace.saved.first_edit = first_edit;
}

void mark_saved(Workspace& workspace) {
  workspace.saved.cage = workspace.document.cage;
  workspace.saved.scheme = workspace.document.scheme;
  workspace.saved.mask = workspace.document.mask;
  workspace.saved.probes = workspace.document.probes;
  workspace.saved.sets = workspace.document.groups.sets;
  workspace.saved.library = workspace.document.library;
  workspace.saved.timeline = workspace.document.timeline;
  mark_pose_saved(workspace);
}

// In a session alone: the file of a pose has no probes.
void mark_pose_saved(Workspace& workspace) {
  workspace.saved.pose = real_pose(workspace.document);
  workspace.saved.nowhere = false;
  ++workspace.saved.revision;
  if (!has_unsaved_edits(workspace)) mark_edits_saved(workspace, "");
}

}  // namespace viete::scene
