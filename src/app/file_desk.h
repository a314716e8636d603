// Opens, saves and exports files for the viewer in the background, backs up unsaved edits, and stores
// preferences.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/autosave.h"
#include "app/model_layer.h"
#include "app/view_model.h"
#include "base/background.h"
#include "base/progress.h"
#include "files/animation_export.h"
#include "files/export.h"
#include "files/open.h"
#include "files/session.h"
#include "workspace/messages.h"
#include "workspace/workspace.h"

namespace viete::app {

struct Loaded {
  files::Opened opened;
  ModelShading shading;                           ///< empty if the model is unchanged
  Bound bound;                                    ///< the binding of a new model or cage; otherwise empty
  std::optional<workspace::Question> question{};  ///< set if the user must answer before files can be opened
  files::OpenRequest request{};                   ///< if there is a question: the request to repeat
};
using Loader = base::BackgroundJob<Loaded>;

/// Cancels a running request and starts `request`. If reading or binding fails, the open document stays
/// unchanged. See shading_of() for `moving`.
void start_loading(Loader& loader, const files::OpenRequest& request, const document::Document& current,
                   std::size_t moving = std::numeric_limits<std::size_t>::max());

struct PictureExport {
  std::filesystem::path file;     ///< pattern of the file names, such as frame_####.png
  std::filesystem::path program;  ///< the program `viete`
  files::Session session;         ///< the session to draw, with its playback range and view
  bool panels = false;
  bool replaces = false;  ///< replaces existing pictures
};

/// Runs exports one after another. The destructor cancels unfinished exports. Each file is written completely
/// or not at all. Not thread-safe.
class Exporter {
public:
  struct Failure {
    std::filesystem::path file;
    std::string problem;
  };

  /// See base::BackgroundQueue for `wake`.
  explicit Exporter(base::Wake wake = nullptr) : job_(std::move(wake)) {}

  /// what.file must have passed check_output(). A note in `shown_notes` is not shown again.
  void add(files::Export what, std::vector<std::string> shown_notes = {});
  void add(files::AnimationExport what, std::vector<std::string> shown_notes = {});
  void add(PictureExport what);
  /// Cancels the running export. When this export has ended, the next export starts.
  void stop() { job_.stop(); }
  bool running() const { return job_.running(); }
  bool has_result() const { return job_.has_result(); }
  workspace::WorkState state() const;
  /// If `wait` is true, waits for the running export. If an export has finished, starts the next export.
  /// Reports success or cancelling in `messages`. A failure is returned, but not reported.
  std::optional<Failure> follow(workspace::Messages& messages, bool wait = false);

private:
  struct Written {
    std::string summary;
    std::vector<std::string> notes;
  };
  struct Work {
    std::filesystem::path file;
    std::string stopped;  ///< end of the message after cancelling
    std::function<Written(base::Progress&)> write;
    std::vector<std::string> shown_notes{};
  };
  void add(Work work);
  void start_next();
  void tell(workspace::Messages& messages, Written&& written) const;

  std::deque<Work> waiting_;
  Work now_;  ///< the running export; its `write` is moved to job_
  base::BackgroundJob<Written> job_;
};

std::filesystem::path preferences_file(const std::filesystem::path& state);

class FileDesk {
public:
  /// Loads the preferences into the workspace. `state` is the folder for preferences and backups. If it is
  /// empty, nothing is stored. `program` is the path of `viete`, which renders animations in a child process.
  FileDesk(const std::filesystem::path& state, workspace::Workspace& workspace,
           std::filesystem::path program = base::os::program_file(), const base::Wake& wake = nullptr);

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
