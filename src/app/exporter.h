// Exports deformed models, animations and pictures in the background.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/background.h"
#include "base/progress.h"
#include "files/animation_export.h"
#include "files/export.h"
#include "files/session.h"
#include "workspace/messages.h"
#include "workspace/workspace.h"

namespace viete::app {

struct PictureExport {
  std::filesystem::path file;     ///< pattern of the file names, such as frame_####.png
  std::filesystem::path program;  ///< the program `viete`
  files::Session session;         ///< the session to draw, with its playback range and view
  bool panels = false;
  bool replaces = false;  ///< replaces existing pictures
};

/// Draws and writes pictures in a child process. Returns notes for the user, one line each. Throws
/// base::Error with the message of the child process, and base::Cancelled. Thread-safe.
std::vector<std::string> write_pictures_in_child(const PictureExport& what, base::Progress& progress);

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

}  // namespace viete::app
