// Everything with files while the viewer runs: requests are carried out, work is kept, what should be
// remembered is remembered.
#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <utility>
#include <vector>

#include "app/autosave.h"
#include "app/exporter.h"
#include "app/loader.h"
#include "base/background.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// What outlives a run, in this folder.
std::filesystem::path remembered_file(const std::filesystem::path& state);

class FileDesk {
public:
  /// state: the folder to remember in; empty: nothing is remembered or kept. Fills the workspace with what
  /// was remembered. program: `viete`, which draws animations aside.
  FileDesk(const std::filesystem::path& state, scene::Workspace& workspace,
           std::filesystem::path program = "/proc/self/exe");

  /// Before the frame's work: takes requests and answers, and what was read once no drag runs, so that
  /// nothing is taken away under a drag. Asks before edits are lost that cannot be kept. Closes when exports
  /// are written, and not if one fails.
  void take_requests(scene::Workspace& workspace, bool no_drag);
  /// After it: keeps what is new.
  void keep(scene::Workspace& workspace, bool no_drag = true);

  /// True once the program may end, as was requested: nothing is unsaved, or it is kept, or the user has said
  /// so.
  bool closed() const { return closed_; }
  /// True if the edits of this moment have been written for the next start.
  bool kept() const { return autosave_.kept(); }
  /// Waits until they are; false if they cannot be.
  bool keep_now(scene::Workspace& workspace) { return autosave_.keep_now(workspace); }
  /// True if something was kept, or could not be, since keep().
  bool has_news() const { return autosave_.has_news(); }
  bool loading() const { return loader_.running(); }
  /// True while it is found out what an animation would take.
  bool measuring() const { return sizes_.running(); }
  /// True while deformed models are written.
  bool exporting() const { return exporter_.running(); }
  /// Waits for the files that are being read, and takes them.
  void finish_loading(scene::Workspace& workspace) { take_loaded(workspace, true); }
  /// Waits for those that are being written, and says so.
  void finish_exports(scene::Workspace& workspace);
  /// The shading of the model that was read last.
  ModelShading& shading() { return shading_; }
  /// What was bound with the document that was taken last; once.
  Bound take_bound() { return std::exchange(bound_, {}); }

private:
  void start_export(const scene::Workspace& w, const std::filesystem::path& file);
  using StartExport = void (FileDesk::*)(const scene::Workspace&, const std::filesystem::path&);
  void export_to(scene::Workspace& w, const std::filesystem::path& file, StartExport start);
  PictureExport picture_export_of(const scene::Workspace& w, const std::filesystem::path& file) const;
  void start_animation_export(const scene::Workspace& w, const std::filesystem::path& file);
  void take_loaded(scene::Workspace& workspace, bool wait);
  void take(scene::Workspace& workspace, Loader::Loaded&& loaded);
  void take_answer(scene::Workspace& workspace, scene::Answer answer);
  void go_on(scene::Workspace& workspace, scene::Question::Kind kind);
  void go_on_after_saving(scene::Workspace& workspace);
  void give_up(scene::Workspace& workspace);
  void save_session(scene::Workspace& workspace, const std::filesystem::path& file, bool over_changes);
  void close(scene::Workspace& workspace);
  void follow_exports(scene::Workspace& workspace, bool wait);
  void show_exports(scene::Workspace& workspace);
  void follow_dialog(scene::FileBrowser& browser, const scene::Workspace& w);
  void discard(scene::Workspace& workspace);
  void remember(scene::Workspace& workspace);
  void take_written(scene::Workspace& workspace);

  std::filesystem::path state_, program_;
  Loader loader_;
  Exporter exporter_;
  MorphSizes sizes_;
  ModelShading shading_;
  Bound bound_;
  std::filesystem::path reading_;          // the first file that was asked for last
  std::optional<Loader::Loaded> waiting_;  // for the answer whether it may take the place of what is open
  bool closing_ = false, closed_ = false;  // closing waits for exports
  std::vector<std::future<void>> writes_;  // of small files, until it is known how they went
  base::BackgroundQueue queue_;
  Autosave autosave_;
  scene::Remembered written_;
};

}  // namespace viete::app
