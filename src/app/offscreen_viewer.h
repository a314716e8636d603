// A viewer without a window, the options of its pictures, and numbered pictures of a timeline.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/viewer.h"
#include "base/progress.h"
#include "files/open.h"
#include "platform/offscreen_context.h"

namespace CLI {
class App;
}

namespace viete::app {

class OffscreenViewer {
public:
  /// OffscreenContext::create() throws base::Error if there is no such context.
  explicit OffscreenViewer(const ViewerOptions& options, std::unique_ptr<platform::OffscreenContext> context =
                                                             platform::OffscreenContext::create());

  Viewer& viewer() { return viewer_; }
  /// Renders frames of 1/60 s until nothing changes: fonts and windows settled, model bound, no motion.
  void settle();

private:
  std::unique_ptr<platform::OffscreenContext> context_;
  render::Gl gl_;
  Viewer viewer_;
};

struct PictureOptions {
  ViewerOptions viewer{.samples = 4};
  bool panels = false, light = false, cage = false, wireframe = false, no_grid = false;
  std::string look, shading, map;    ///< empty: not given
  std::vector<std::string> compare;  ///< deformers or methods, one view each
  std::filesystem::path camera;      ///< a session to take the camera from; empty: none
  bool panels_of_session = true;     ///< show panels if the session's window did
  glm::ivec2 size{0, 0};             ///< 0: as the session's window
};

/// --size, --scale, --look, --shading and flags. The target must outlive parsing.
void add_picture_options(CLI::App& command, PictureOptions& options);

/// A viewer of the opened document, with the camera and view of its session unless options override them. Its
/// first picture is ready after settle().
std::unique_ptr<OffscreenViewer> viewer_of(const PictureOptions& options, files::Opened&& opened);

/// Prints the viewer's messages to stderr. Throws base::Error if it failed.
void print_messages(const workspace::Workspace& workspace);

struct PictureRun {
  std::filesystem::path file;  ///< frame_####.png
  std::vector<int> frames;
  double rate = 24;                         ///< timeline frames per second
  int step = 1;                             ///< timeline frames between pictures
  bool turntable = false;                   ///< a full camera turn from the first picture to the last
  files::Force force = files::Force::none;  ///< replace existing pictures
};

/// Renders the viewer's document, following its timeline and camera keys. Each file is written completely or
/// not at all. Returns notes for the user, one line each: the last one is ffmpeg_command(), if the numbers
/// have no gaps. Throws base::Error and base::Cancelled.
std::vector<std::string> write_pictures(OffscreenViewer& offscreen, const PictureRun& run,
                                        base::Progress& progress);

/// The shell command that converts the pictures to a film at the timeline's rate, one line.
/// The numbers must not have gaps.
std::string ffmpeg_command(const PictureRun& run);

}  // namespace viete::app
