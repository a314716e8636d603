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
  std::filesystem::path file;     ///< frame_####.png
  std::filesystem::path program;  ///< `viete`
  files::Session session;         ///< a snapshot: playback range and view
  bool panels = false;
};

/// Runs in a child process. Throws base::Error with its error message, and base::Cancelled. Returns messages
/// about the result for the user, one line each. Thread-safe.
std::vector<std::string> write_pictures_in_child(const PictureExport& what, base::Progress& progress);

/// Runs exports one after the other, in order. Call from one thread. The destructor cancels unfinished
/// exports; their files are unchanged.
class Exporter {
public:
  struct Failure {
    std::filesystem::path file;
    std::string problem;
  };

  /// The file must have passed check_output(). `shown_notes`: notes that the window shows already.
  void add(files::Export what, std::vector<std::string> shown_notes = {});
  void add(files::AnimationExport what, std::vector<std::string> shown_notes = {});
  void add(PictureExport what);
  /// Cancels the running export, which ends soon; then the next waiting export starts.
  void stop() { job_.stop(); }
  bool running() const { return job_.running(); }
  workspace::WorkState state() const;
  /// Reports finished exports in `messages` and starts the next one. With `wait`, waits for the running one.
  /// Returns the failed one, if any.
  std::optional<Failure> follow(workspace::Messages& messages, bool wait = false);

private:
  struct Written {
    std::string summary;
    std::vector<std::string> notes;
  };
  struct Work {
    std::filesystem::path file;
    std::string stopped;  ///< message if cancelled
    std::function<Written(base::Progress&)> write;
    std::vector<std::string> shown_notes{};
  };
  void add(Work work);
  void start_next();
  void tell(workspace::Messages& messages, Written&& written) const;

  std::deque<Work> waiting_;
  Work now_;  ///< the running one, without `write`
  base::BackgroundJob<Written> job_;
};

}  // namespace viete::app
