// A viewer without a window: for `viete render`, for machines without a display, and for tests.
#pragma once

#include <memory>

#include "app/viewer.h"
#include "platform/offscreen_context.h"

namespace viete::app {

class OffscreenViewer {
public:
  /// Throws base::Error when no offscreen context can be had.
  explicit OffscreenViewer(const ViewerOptions& options,
                           platform::OffscreenContext::Kind kind = platform::OffscreenContext::Kind::any);

  Viewer& viewer() { return *viewer_; }
  /// Frames of 1/60 s until the picture is at rest: fonts and windows settled, model bound, nothing moving.
  void settle();

private:
  std::unique_ptr<platform::OffscreenContext> context_;
  std::unique_ptr<render::Gl> gl_;
  std::unique_ptr<Viewer> viewer_;
};

}  // namespace viete::app
