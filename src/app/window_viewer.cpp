#include "app/window_viewer.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/autosave.h"
#include "app/file_desk.h"
#include "app/viewer.h"
#include "base/clock.h"
#include "base/error.h"
#include "platform/window.h"
#include "scene/workspace/command.h"
#include "scene/workspace/saving.h"

namespace viete::app {

namespace {

ViewerOptions viewer_options(const platform::Window& window) {
  ViewerOptions options;
  options.size = window.size();
  options.scale = window.scale();
  options.samples = window.gl().software ? 0 : 4;
  options.still_samples = window.gl().software ? 4 : 0;
  options.may_be_coarse = true;
  options.state = state_folder();
  return options;
}

// The viewer in its window, redrawn on changes.
class WindowViewer {
public:
  explicit WindowViewer(platform::Window& window)
      : window_(window), viewer_(window.gl(), viewer_options(window)) {
    listen();
    scene::Preferences& preferences = viewer_.workspace().preferences;
    viewer_.workspace().ask_keys = std::exchange(preferences.ask_keys, false) && preferences.hints;
    window_.share_clipboard();
  }

  Viewer& viewer() { return viewer_; }
  /// Runs until it is closed, or for that many frames; 0: unlimited.
  void run(int frames);

private:
  void listen();
  void draw(float seconds, bool exposed = false);
  void follow_full_screen();

  platform::Window& window_;
  Viewer viewer_;
  bool exposed_ = true;
};

void WindowViewer::listen() {
  platform::WindowEvents events;
  events.input = [this](platform::InputEvent event) { viewer_.input().push(std::move(event)); };
  events.dropped = [this](std::vector<std::filesystem::path> files) {
    viewer_.drop(std::move(files));
    exposed_ = true;
  };
  events.exposed = [this] {
    viewer_.resize(window_.size());
    if (!window_.full_screen()) viewer_.workspace().preferences.window = window_.size();
    exposed_ = true;
  };
  window_.listen(std::move(events));
}

// Without a title bar a message tells how to leave full screen.
void WindowViewer::follow_full_screen() {
  scene::Workspace& w = viewer_.workspace();
  if (w.full_screen == window_.full_screen()) return;
  window_.set_full_screen(w.full_screen);
  w.full_screen = window_.full_screen();  // may fail without a suitable screen
  exposed_ = true;
  if (!w.full_screen) return;
  const scene::Command& command = *scene::find_command("toggle_full_screen");
  const std::string key = scene::text(w.preferences.keymap.of(command).first);
  w.messages.info(key.empty() ? "View > Full screen leaves full screen." : key + " leaves full screen.");
}

void WindowViewer::draw(float seconds, bool exposed) {
  viewer_.frame(seconds);
  if (viewer_.has_drawn() || exposed) window_.present(viewer_.framebuffer());
  window_.set_title(scene::window_title(viewer_.workspace()));
  follow_full_screen();
}

void WindowViewer::run(int frames) {
  double last = base::wall_seconds();
  for (int drawn = 0; frames == 0 || drawn < frames;) {
    window_.poll_events();
    const bool needed = exposed_ || viewer_.wants_frame();
    if (!needed) window_.wait_for_events(viewer_.working() ? 0.02 : 0.1);
    if (window_.asked_to_close()) viewer_.workspace().requests.quit = exposed_ = true;
    if (!exposed_ && !viewer_.wants_frame() && frames == 0) continue;
    const double now = base::wall_seconds();
    draw(static_cast<float>(std::min(now - last, 0.1)), std::exchange(exposed_, false));
    last = now;
    if (!viewer_.has_drawn()) window_.wait_for_events(0.004);  // nothing was presented, so there is no vsync
    if (viewer_.closed()) return;
    if (!viewer_.loading()) ++drawn;
  }
}

}  // namespace

// The last size; read errors are reported by the viewer.
glm::ivec2 last_window_size() {
  constexpr glm::ivec2 usual{1440, 900};
  try {
    return scene::read_preferences(preferences_file(state_folder())).window.value_or(usual);
  } catch (const base::Error&) {
    return usual;
  }
}

bool run_window(const WindowOptions& options, std::string& reason) {
  const auto window = platform::Window::open(last_window_size(), options.scale, reason);
  if (!window) return false;
  WindowViewer shown(*window);
  Viewer& viewer = shown.viewer();
  scene::Workspace& workspace = viewer.workspace();
  if (state_folder().empty())
    workspace.messages.warn("There is no home folder: unsaved edits cannot be recovered. Save often.");
  // Also for what is opened instead, if this cannot be.
  if (!options.inputs.session()) scene::put_settings(workspace.document, options.inputs.settings);
  workspace.requests.open = options.inputs.request();
  shown.run(options.frames);
  if (!viewer.closed()) viewer.finish_keeping();
  if (viewer.keeping()) {
    std::fprintf(stderr, "viete: unsaved edits were saved; the next start offers to restore them\n");
  }
  return true;
}

}  // namespace viete::app
