// A viewer without a window: for `viete render`, for machines without a display, and for tests.
#pragma once

#include <memory>

#include "app/viewer.h"
#include "platform/offscreen_context.h"

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
