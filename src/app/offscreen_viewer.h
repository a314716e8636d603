// A viewer without a window, and the options of its pictures.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/viewer.h"
#include "platform/offscreen_context.h"
#include "scene/files/open.h"

namespace viete::app {

class OffscreenViewer {
public:
  /// OffscreenContext::create() throws base::Error when there is no such context.
  explicit OffscreenViewer(const ViewerOptions& options, std::unique_ptr<platform::OffscreenContext> context =
                                                             platform::OffscreenContext::create());

  Viewer& viewer() { return viewer_; }
  /// Frames of 1/60 s until the picture is at rest: fonts and windows settled, model bound, nothing moving.
  void settle();

private:
  std::unique_ptr<platform::OffscreenContext> context_;
  render::Gl gl_;
  Viewer viewer_;
};

}  // namespace viete::app

namespace CLI {
class App;
}

namespace viete::app {

struct PictureOptions {
  ViewerOptions viewer{.samples = 4};
  bool panels = false, light = false, error_map = false, cage = false, wireframe = false, no_grid = false;
  std::string look = "home", shading, map;
  std::vector<std::string> compare;             ///< ways or methods, a view each
  std::filesystem::path camera;                 ///< a session whose camera is taken; empty: none
  bool panels_of_session = true;                ///< are shown where its window had them
  bool size_given = false, look_given = false;  ///< after parsing, see take_given()
};

/// --size, --scale, --look, --shading and flags. The target must outlive parsing.
void add_picture_options(CLI::App& command, PictureOptions& options);
/// What was given, and not left as it is.
void take_given(const CLI::App& command, PictureOptions& options);

/// A viewer of what was opened, with the camera and the view of its session where these are not asked for
/// otherwise. Its first picture is there once it has settled.
std::unique_ptr<OffscreenViewer> viewer_of(const PictureOptions& options, scene::Opened&& opened);

/// What the viewer has to say, on stderr. Throws base::Error where it could not do its work.
void print_messages(const scene::Workspace& workspace);

}  // namespace viete::app
