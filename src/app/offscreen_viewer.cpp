#include "app/offscreen_viewer.h"

namespace viete::app {

OffscreenViewer::OffscreenViewer(const ViewerOptions& options, platform::OffscreenContext::Kind kind)
    : context_(platform::OffscreenContext::create(kind)) {
  gl_ = std::make_unique<render::Gl>(
      render::load_gl([this](const char* name) { return context_->get_proc_address(name); }));
  viewer_ = std::make_unique<Viewer>(*gl_, options);
}

void OffscreenViewer::settle() {
  constexpr float frame_seconds = 1.0f / 60;
  viewer_->frame(frame_seconds);
  viewer_->finish_loading();
  viewer_->finish_exports();
  viewer_->frame(frame_seconds);
  viewer_->finish_binding();
  if (viewer_->workspace().view.panels) viewer_->finish_checks();
  for (int i = 0; i < 200 && viewer_->wants_frame(); ++i) viewer_->frame(frame_seconds);
  viewer_->finish_views();
  if (viewer_->workspace().view.panels) viewer_->finish_measuring();
  viewer_->frame(frame_seconds);
}

}  // namespace viete::app
