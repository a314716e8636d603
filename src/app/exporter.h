// Writes deformed models, animations and pictures in the background.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/background.h"
#include "base/progress.h"
#include "scene/files/animation_export.h"
#include "scene/files/export.h"
#include "scene/files/session.h"
#include "scene/workspace/messages.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

struct PictureExport {
  std::filesystem::path file;     ///< frame_####.png
  std::filesystem::path program;  ///< `viete`
  scene::Session session;         ///< as it is at one moment: what plays, as it is looked at
  bool panels = false;
};

/// Throws base::Error with what the other run says, and base::Cancelled. Returns what a person should know of
/// the result, one line each. Thread-safe.
std::vector<std::string> write_pictures_aside(const PictureExport& what, base::Progress& progress);

/// One after the other, in the order they were asked for. Call from one thread. The destructor stops what is
/// not finished: files that are not written yet are as they were.
class Exporter {
public:
  struct Failure {
    std::filesystem::path file;
    std::string problem;
  };

  /// The file must have passed check_output(). `told`: notes that the window shows already.
  void add(scene::Export what, std::vector<std::string> told = {});
  void add(scene::AnimationExport what, std::vector<std::string> told = {});
  void add(PictureExport what);
  /// Asks the one that is being written to stop, which it does within moments; those that wait follow.
  void stop() { job_.stop(); }
  bool running() const { return job_.running(); }
  scene::WorkState state() const;
  /// Says what was written since the last call, and goes on with the next. With wait, waits for the one that
  /// is being written. Returns the one that failed.
  std::optional<Failure> follow(scene::Messages& messages, bool wait = false);

private:
  struct Written {
    std::string summary;
    std::vector<std::string> notes;
  };
  struct Work {
    std::filesystem::path file;
    std::string stopped;  ///< what is said then
    std::function<Written(base::Progress&)> write;
    std::vector<std::string> told{};
  };
  void add(Work work);
  void start_next();
  void tell(scene::Messages& messages, Written&& written) const;

  std::deque<Work> waiting_;
  Work now_;  ///< that is being done, but for how
  base::BackgroundJob<Written> job_;
};

class MorphSizes {
public:
  /// Every frame: says it in the file browser, once it is known.
  void follow(scene::Workspace& workspace);
  bool running() const { return job_.running(); }

private:
  struct Asked {
    scene::MorphChoice choice;
    std::string format;
    friend bool operator==(const Asked&, const Asked&) = default;
  };
  std::optional<Asked> asked_;
  base::BackgroundJob<scene::MorphEstimate> job_;
};

}  // namespace viete::app
