// Draws pictures without a window: a viewer, its options, and numbered pictures of a timeline.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
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
  /// OffscreenContext::create() throws base::Error if drawing without a window is not available.
  explicit OffscreenViewer(const ViewerOptions& options, std::unique_ptr<platform::OffscreenContext> context =
                                                             platform::OffscreenContext::create());

  Viewer& viewer() { return viewer_; }
  /// Renders frames of 1/60 s until loading, binding and motion end. If panels are shown, also measures.
  void settle();

private:
  std::unique_ptr<platform::OffscreenContext> context_;
  render::Gl gl_;
  Viewer viewer_;
};

struct PictureOptions {
  ViewerOptions viewer{.samples = 4};
  bool panels = false, light = false, cage = false, wireframe = false, no_grid = false;
  std::string look;  ///< empty if the option is missing
  std::optional<document::Shading> shading;
  std::optional<analysis::Field> map;
  std::vector<std::string> compare;  ///< one deformer, method or interpolation per view
  std::filesystem::path camera;      ///< the session whose camera is used; may be empty
  std::optional<int> frame;          ///< a frame of the timeline; by default, the session's frame
  glm::ivec2 size{0, 0};             ///< 0: the size of the session's window
};

/// Adds the options of a picture to a command. `options` must outlive parsing.
void add_picture_options(CLI::App& command, PictureOptions& options);

/// Returns a viewer of the opened document. Options override the camera and the view settings of the session.
/// Call settle() before the first picture.
std::unique_ptr<OffscreenViewer> viewer_of(const PictureOptions& options, files::Opened&& opened);

/// Prints the viewer's messages to stderr. If a message is an error, throws base::Error.
void print_messages(const workspace::Workspace& workspace);

struct PictureRun {
  std::filesystem::path file;  ///< pattern of the file names, such as frame_####.png
  std::vector<int> frames;
  double rate = 24;                         ///< frames of the timeline per second
  int step = 1;                             ///< difference between successive numbers in `frames`
  bool turntable = false;                   ///< true: the camera makes a full turn around the model
  files::Force force = files::Force::none;  ///< whether to replace existing pictures
};

/// Writes a picture of the viewer's document for each frame. Each file is written completely or not at all.
/// Returns notes for the user, one line each. Throws base::Error. If cancelled, throws base::Cancelled.
std::vector<std::string> write_pictures(OffscreenViewer& offscreen, const PictureRun& run,
                                        base::Progress& progress);

/// Returns a shell command that converts the pictures to a film. The frame numbers must have no gaps.
std::string ffmpeg_command(const PictureRun& run);

}  // namespace viete::app
