// Opens, saves and exports files for the viewer, backs up unsaved edits, and stores preferences.
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

std::filesystem::path preferences_file(const std::filesystem::path& state);

class FileDesk {
public:
  /// Loads the preferences into the workspace. `state` is the folder for preferences and backups. If it is
  /// empty, nothing is stored. `program` is the path of `viete`, which renders animations in a child process.
  FileDesk(const std::filesystem::path& state, workspace::Workspace& workspace,
           std::filesystem::path program = "/proc/self/exe");

  /// Call at the start of each frame. Handles the user's requests and answers. If `no_drag`, applies opened
  /// files. If edits would be lost and cannot be backed up, asks the user first. Closing waits for exports;
  /// if an export fails, closing is cancelled.
  void take_requests(workspace::Workspace& workspace, bool no_drag);
  /// Call at the end of each frame. Backs up new edits and stores changed preferences.
  void keep(workspace::Workspace& workspace, bool no_drag = true);

  /// True if the user asked to close, and edits are saved, backed up or discarded.
  bool closed() const { return closed_; }
  /// True if the current edits have been backed up.
  bool kept() const { return autosave_.kept(); }
  /// Backs up the current edits and waits. Returns false if the backup fails.
  bool keep_now(workspace::Workspace& workspace) { return autosave_.keep_now(workspace); }
  /// True if a backup has finished or failed since the last keep().
  bool has_news() const { return autosave_.has_news(); }
  bool loading() const { return loader_.running(); }
  bool exporting() const { return exporter_.running(); }
  /// Waits until files are read, and applies the result.
  void finish_loading(workspace::Workspace& workspace) { take_loaded(workspace, true); }
  /// Waits for running exports and reports their results.
  void finish_exports(workspace::Workspace& workspace);
  /// The shading of the last opened model.
  ModelShading& shading() { return shading_; }
  /// Moves the binding of the last opened document to the caller.
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
  void save_session(workspace::Workspace& workspace, const std::filesystem::path& file,
                    std::optional<workspace::Question::Kind> answered = {});
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
  std::filesystem::path reading_;          // the first file of the last request
  std::filesystem::path session_;          // the session of the last request to save
  std::optional<Loaded> waiting_;          // the opened document, while the user decides about unsaved edits
  bool closing_ = false, closed_ = false;  // closing_: true while closing waits for exports
  std::vector<std::future<void>> writes_;  // pending writes of preferences
  base::BackgroundQueue queue_;
  Autosave autosave_;
  workspace::Preferences written_;
};

}  // namespace viete::app
