// File handling of the viewer: carries out requests, backs up unsaved work, and stores preferences.
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
#include "workspace/workspace.h"

namespace viete::app {

/// The preferences file in this folder.
std::filesystem::path preferences_file(const std::filesystem::path& state);

class FileDesk {
public:
  /// state: the folder for preferences and recovery; empty: none. Loads the preferences into the workspace.
  /// program: `viete`, which renders animations in a child process.
  FileDesk(const std::filesystem::path& state, workspace::Workspace& workspace,
           std::filesystem::path program = "/proc/self/exe");

  /// Call before the frame's work: handles requests and answers, and applies read files unless a drag is
  /// running. Asks before edits are lost that cannot be backed up. On closing waits for exports; a failed
  /// export stops closing.
  void take_requests(workspace::Workspace& workspace, bool no_drag);
  /// Call after the frame: backs up new edits.
  void keep(workspace::Workspace& workspace, bool no_drag = true);

  /// True once a requested close may proceed: no unsaved edits, backed up edits, or the user's consent.
  bool closed() const { return closed_; }
  /// True if the current edits have been backed up.
  bool kept() const { return autosave_.kept(); }
  /// Backs them up and waits; false if that fails.
  bool keep_now(workspace::Workspace& workspace) { return autosave_.keep_now(workspace); }
  /// True if a backup has finished or failed since keep().
  bool has_news() const { return autosave_.has_news(); }
  bool loading() const { return loader_.running(); }
  /// True while exports are running.
  bool exporting() const { return exporter_.running(); }
  /// Waits for the files being read and applies them.
  void finish_loading(workspace::Workspace& workspace) { take_loaded(workspace, true); }
  /// Waits for running exports and reports them.
  void finish_exports(workspace::Workspace& workspace);
  /// The shading of the last model read.
  ModelShading& shading() { return shading_; }
  /// The binding of the last document applied; returned only once.
  Bound take_bound() { return std::exchange(bound_, {}); }

private:
  void start_export(const workspace::Workspace& w, const std::filesystem::path& file);
  using StartExport = void (FileDesk::*)(const workspace::Workspace&, const std::filesystem::path&);
  void export_to(workspace::Workspace& w, const std::filesystem::path& file, StartExport start);
  PictureExport picture_export_of(const workspace::Workspace& w, const std::filesystem::path& file) const;
  void start_animation_export(const workspace::Workspace& w, const std::filesystem::path& file);
  void take_loaded(workspace::Workspace& workspace, bool wait);
  void take(workspace::Workspace& workspace, Loaded&& loaded);
  void take_answer(workspace::Workspace& workspace, workspace::Answer answer);
  void proceed(workspace::Workspace& workspace, workspace::Question::Kind kind);
  void proceed_after_saving(workspace::Workspace& workspace);
  void give_up(workspace::Workspace& workspace);
  void save_session(workspace::Workspace& workspace, const std::filesystem::path& file, bool over_changes);
  void close(workspace::Workspace& workspace);
  void follow_exports(workspace::Workspace& workspace, bool wait);
  void show_exports(workspace::Workspace& workspace);
  void follow_dialog(workspace::FileBrowser& browser, const workspace::Workspace& w);
  void discard(workspace::Workspace& workspace);
  void remember(workspace::Workspace& workspace);
  void take_written(workspace::Workspace& workspace);

  std::filesystem::path state_, program_;
  Loader loader_;
  Exporter exporter_;
  ModelShading shading_;
  Bound bound_;
  std::filesystem::path reading_;          // first file of the last request
  std::optional<Loaded> waiting_;          // read, and waiting for an answer to replace the document
  bool closing_ = false, closed_ = false;  // closing waits for exports
  std::vector<std::future<void>> writes_;  // writes of small files, until their result is known
  base::BackgroundQueue queue_;
  Autosave autosave_;
  workspace::Preferences written_;
};

}  // namespace viete::app
