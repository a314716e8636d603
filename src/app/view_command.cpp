// viete [view] [MODEL [CAGE]]: opens the window, or renders a picture without a display.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/assets.h"
#include "app/command_line.h"
#include "app/first_motion.h"
#include "app/help.h"
#include "app/offscreen_viewer.h"
#include "app/options.h"
#include "app/window_viewer.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/workspace/apply_opened.h"

namespace viete::app {

namespace {

namespace fs = std::filesystem;

// Without a display: renders the window's picture and prints one line about it.
int render_instead(const WindowOptions& options, const std::string& reason) {
  const fs::path picture = base::unused_name(fs::current_path() / "viete.png");
  try {
    base::check_replaceable(picture);
  } catch (const base::Error& error) {
    throw base::Error("", "no window (" + reason + ") and no picture instead: " + error.what());
  }
  ViewerOptions viewer_options;
  viewer_options.samples = 4;
  viewer_options.scale = options.scale > 0 ? options.scale : 1;
  viewer_options.size = {1440, 900};
  OffscreenViewer offscreen(viewer_options);
  scene::Workspace& workspace = offscreen.viewer().workspace();
  scene::apply_opened(workspace, open(options.inputs, scene::check_drawable));
  FirstMotion motion(options.first_pose);
  motion.step(workspace, true, 0);
  motion.finish(workspace);
  offscreen.settle();
  render::write_png(picture, offscreen.viewer().picture());
  std::fprintf(stderr, "viete: no window (%s); wrote a picture to %s instead\n", reason.c_str(),
               picture.c_str());
  return exit_ok;
}

int view(WindowOptions options) {
  Inputs& inputs = options.inputs;
  if (inputs.model.empty()) {
    const BundledModel bundled = bundled_model();
    inputs.model = bundled.model;
    inputs.cage = bundled.cage;
    if (!bundled.poses.empty()) options.first_pose = bundled.poses.front();  // by name: the alert pose
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
      ->default_str("as the display");
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
