// viete [view] [MODEL [CAGE]]: opens the window, or renders a picture without a display.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/assets.h"
#include "app/inputs.h"
#include "app/offscreen_viewer.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "platform/window.h"
#include "workspace/command.h"
#include "workspace/open_save.h"

namespace viete::app {

namespace {

namespace fs = std::filesystem;

struct WindowOptions {
  Inputs inputs{Use::window};
  float scale = 0;  ///< device pixels per logical pixel; 0: the display's scale
  int frames = 0;   ///< close after this number of frames; 0: never
};

ViewerOptions viewer_options(const platform::Window& window) {
  ViewerOptions options;
  options.size = window.size();
  options.scale = window.scale();
  options.samples = window.gl().software ? 0 : 4;
  options.still_samples = window.gl().software ? 4 : 0;
  options.may_be_coarse = true;
  options.state = state_folder();
  options.wake = platform::Window::wake;
  return options;
}

// A viewer in a window. The window is redrawn if something changes.
class WindowViewer {
public:
  explicit WindowViewer(platform::Window& window)
      : window_(window), viewer_(window.gl(), viewer_options(window)) {
    platform::WindowEvents events;
    events.input = [this](platform::InputEvent event) { viewer_.input().push(std::move(event)); };
    events.dropped = [this](std::vector<std::filesystem::path> files) {
      viewer_.drop(std::move(files));
      exposed_ = true;
    };
    events.exposed = [this] {
      viewer_.resize(window_.size(), window_.scale());
      if (!window_.full_screen()) viewer_.workspace().preferences.window = window_.size();
      exposed_ = true;
    };
    window_.listen(std::move(events));
    scale_ = viewer_.workspace().preferences.scale;
    viewer_.workspace().panels.ask_keys = viewer_.workspace().preferences.ask_keys;
    window_.share_clipboard();
  }

  Viewer& viewer() { return viewer_; }
  // If `frames` is 0, runs until the window is closed. Otherwise, also ends after this number of frames.
  void run(int frames) {
    double last = base::wall_seconds();
    for (int drawn = 0; frames == 0 || drawn < frames;) {
      window_.wait_for_events(exposed_ || frames > 0 ? 0 : viewer_.due_in());
      if (window_.asked_to_close()) viewer_.workspace().jobs.wishes.add(workspace::CloseProgram{});
      if (!exposed_ && !viewer_.wants_frame() && frames == 0) continue;
      const double now = base::wall_seconds();
      draw(static_cast<float>(std::min(now - last, 0.1)), std::exchange(exposed_, false));
      last = now;
      if (!viewer_.has_drawn()) window_.wait_for_events(0.004);  // replaces vsync if nothing was presented
      if (viewer_.closed()) return;
      if (!viewer_.loading()) ++drawn;
    }
  }

private:
  void draw(float seconds, bool exposed) {
    viewer_.frame(seconds);
    if (viewer_.has_drawn() || exposed) window_.present(viewer_.framebuffer());
    window_.set_title(workspace::window_title(viewer_.workspace()));
    follow_full_screen();
    follow_scale();
  }

  // Full screen has no title bar, so a message shows how to leave full screen.
  void follow_full_screen() {
    workspace::Workspace& w = viewer_.workspace();
    if (w.view.full_screen == window_.full_screen()) return;
    window_.set_full_screen(w.view.full_screen);
    w.view.full_screen = window_.full_screen();  // full screen may not be available
    exposed_ = true;
    if (!w.view.full_screen) return;
    const workspace::Command& command = *workspace::find_command("toggle_full_screen");
    const std::string key = workspace::text(w.preferences.keymap.of(command).first);
    w.messages.info(key.empty() ? "View > Full screen leaves full screen." : key + " leaves full screen.");
  }

  void follow_scale() {
    const std::optional<float> wanted = viewer_.workspace().preferences.scale;
    if (std::exchange(scale_, wanted) != wanted) window_.set_scale(wanted.value_or(0));
  }

  platform::Window& window_;
  Viewer viewer_;
  bool exposed_ = true;
  std::optional<float> scale_;  // the preference that the window has applied
};

// Returns the preferences, or defaults if they cannot be read. The viewer reports the error.
workspace::Preferences last_preferences() {
  try {
    return workspace::read_preferences(preferences_file(state_folder()));
  } catch (const base::Error&) {
    return {};
  }
}

// Runs the window. If no window can be opened, returns false and sets `reason`.
bool run_window(const WindowOptions& options, std::string& reason) {
  const workspace::Preferences last = last_preferences();
  const float scale = options.scale > 0 ? options.scale : last.scale.value_or(0);
  const auto window = platform::Window::open(last.window.value_or(glm::ivec2(1440, 900)), scale, reason);
  if (!window) return false;
  WindowViewer shown(*window);
  Viewer& viewer = shown.viewer();
  workspace::Workspace& workspace = viewer.workspace();
  if (state_folder().empty())
    workspace.messages.warn("There is no home folder, so unsaved edits cannot be recovered. Save often.");
  // Keeps these settings for the next document if this document cannot be opened.
  if (!options.inputs.session()) document::put_settings(workspace.document, options.inputs.settings);
  workspace.jobs.wishes.open(options.inputs.request());
  shown.run(options.frames);
  if (!viewer.closed()) viewer.finish_keeping();
  if (viewer.keeping())
    std::fprintf(stderr, "viete: unsaved edits were backed up; restore them at the next start\n");
  return true;
}

// Renders a picture of the window to a new file and prints the file's name.
int render_instead(const WindowOptions& options, const std::string& reason) {
  const fs::path picture = base::unused_name(fs::current_path() / "viete.png");
  try {
    base::check_replaceable(picture);
  } catch (const base::Error& error) {
    throw base::Error("", "no window can be opened (" + reason + ") and no picture written: " + error.what());
  }
  ViewerOptions viewer_options;
  viewer_options.samples = 4;
  viewer_options.scale = options.scale > 0 ? options.scale : 1;
  viewer_options.size = {1440, 900};
  OffscreenViewer offscreen(viewer_options);
  workspace::Workspace& workspace = offscreen.viewer().workspace();
  workspace::apply_opened(workspace, open(options.inputs, files::check_drawable));
  offscreen.settle();
  render::write_png(picture, offscreen.viewer().picture());
  std::fprintf(stderr, "viete: no window can be opened (%s); saved a picture as %s instead\n", reason.c_str(),
               picture.string().c_str());
  return exit_ok;
}

int view(WindowOptions options) {
  Inputs& inputs = options.inputs;
  if (inputs.model.empty()) {
    const BundledModel bundled = bundled_model();
    inputs.model = bundled.model;
    inputs.cage = bundled.cage;
  }
  std::string reason;
  if (run_window(options, reason)) return exit_ok;
  return render_instead(options, reason);
}

}  // namespace

void add_view_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("view", "Open the viewer (default without a command)");
  auto options = std::make_shared<WindowOptions>();
  add_input_options(*command, options->inputs);
  in_range(command->add_option("--scale", options->scale, "Device pixels per logical pixel"), 0.5, 4)
      ->default_str("the display's scale");
  whole_in_range(command->add_option("--frames", options->frames, "Close after this number of frames"), 0,
                 1'000'000'000)
      ->default_str("never");
  add_examples(*command, {"view model.obj cage.obj", "view scene.viete --method diag"});
  command->callback([options, &action] {
    check_usage(options->inputs);
    action = [options] { return view(*options); };
  });
}

}  // namespace viete::app
