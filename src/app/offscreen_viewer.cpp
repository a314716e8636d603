#include "app/offscreen_viewer.h"

#include <utility>

namespace viete::app {

OffscreenViewer::OffscreenViewer(const ViewerOptions& options,
                                 std::unique_ptr<platform::OffscreenContext> context)
    : context_(std::move(context)),
      gl_(render::load_gl([this](const char* name) { return context_->get_proc_address(name); })),
      viewer_(gl_, options) {}

void OffscreenViewer::settle() {
  constexpr float frame_seconds = 1.0f / 60;
  viewer_.frame(frame_seconds);
  viewer_.finish_loading();
  viewer_.finish_exports();
  viewer_.frame(frame_seconds);
  viewer_.finish_binding();
  if (viewer_.workspace().view.panels) viewer_.finish_checks();
  for (int i = 0; i < 200 && viewer_.wants_frame(); ++i) viewer_.frame(frame_seconds);
  viewer_.finish_views();
  if (viewer_.workspace().view.panels) viewer_.finish_measuring();
  viewer_.frame(frame_seconds);
}

}  // namespace viete::app
