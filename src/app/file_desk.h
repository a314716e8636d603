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
           std::filesystem::path program = "/proc/self/exe", const base::Wake& wake = nullptr);

  /// Reads files in the background; take_opened() returns them. If edits would be lost and cannot be backed
  /// up, first asks the user.
  void open(workspace::Workspace& workspace, const files::OpenRequest& request);
  void cancel_opening() { loader_.stop(); }
  /// Saves a file, or starts its export.
  void save(workspace::Workspace& workspace, const workspace::SaveFile& wish);
  void cancel_export() { exporter_.stop(); }
  void answer(workspace::Workspace& workspace, workspace::Answer answer);
  /// Closes the program after running exports. If an export fails, closing is cancelled. If edits would be
  /// lost and cannot be backed up, asks the user first. Does nothing while a question is open.
  void close(workspace::Workspace& workspace);
  /// Call at the start of each frame, after the wishes. Takes the results of background work; opened files
  /// only if `no_drag`. Returns true if it took a result.
  bool follow(workspace::Workspace& workspace, bool no_drag);
  /// True if follow() would do something now.
  bool is_due(const workspace::Workspace& workspace, bool no_drag) const;
  /// The opened files, once. The caller must apply them to the workspace before the next frame.
  std::optional<Loaded> take_opened() { return std::exchange(opened_, std::nullopt); }
  /// Call at the end of each frame. Backs up new edits and stores changed preferences.
  void keep(workspace::Workspace& workspace, bool no_drag = true);
  /// True if keep() would do something now.
  bool keeps(const workspace::Workspace& workspace) const;

  /// True if the user asked to close, and edits are saved, backed up or discarded.
  bool closed() const { return closed_; }
  /// True if the current edits have been backed up.
  bool kept() const { return autosave_.kept(); }
  /// Backs up the current edits and waits. Returns false if the backup fails.
  bool keep_now(workspace::Workspace& workspace) { return autosave_.keep_now(workspace); }
  bool loading() const { return loader_.running(); }
  bool exporting() const { return exporter_.running(); }
  /// Waits until files are read. Then calls to take_opened() return them.
  void finish_loading(workspace::Workspace& workspace) { take_loaded(workspace, true); }
  /// Waits for running exports and reports their results.
  void finish_exports(workspace::Workspace& workspace);

private:
  void start_export(const workspace::Workspace& w, const std::filesystem::path& file);
  void report_failed_export(workspace::Workspace& w, const std::filesystem::path& file,
                            const std::string& why);
  using StartExport = void (FileDesk::*)(const workspace::Workspace&, const std::filesystem::path&);
  void export_to(workspace::Workspace& w, const std::filesystem::path& file, StartExport start);
  PictureExport picture_export_of(const workspace::Workspace& w, const std::filesystem::path& file) const;
  void start_animation_export(const workspace::Workspace& w, const std::filesystem::path& file);
  bool takes_loaded(const workspace::Workspace& w, bool no_drag) const {
    return no_drag && !w.files.question;
  }
  bool take_loaded(workspace::Workspace& workspace, bool wait);
  void proceed(workspace::Workspace& workspace, workspace::Question::Kind kind);
  bool continues(const workspace::Workspace& workspace) const;
  void continue_after_saving(workspace::Workspace& workspace);
  void give_up(workspace::Workspace& workspace);
  void save_session(workspace::Workspace& workspace, const std::filesystem::path& file,
                    std::optional<workspace::Question::Kind> answered = {});
  bool follow_exports(workspace::Workspace& workspace, bool wait);
  void show_exports(workspace::Workspace& workspace);
  bool ends_dialog(const workspace::Workspace& w) const;
  void end_dialog(workspace::FileBrowser& browser);
  void discard(workspace::Workspace& workspace);
  void remember(workspace::Workspace& workspace);
  void take_written(workspace::Workspace& workspace);

  std::filesystem::path state_, program_;
  Loader loader_;
  Exporter exporter_;
  std::optional<Loaded> opened_;           // for take_opened()
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
