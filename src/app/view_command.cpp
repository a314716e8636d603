// viete [view] [MODEL [CAGE]]: the window, or a picture where there is no display.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/assets.h"
#include "app/command_line.h"
#include "app/offscreen_viewer.h"
#include "app/options.h"
#include "app/window.h"
#include "base/error.h"
#include "scene/session.h"

namespace viete::app {

namespace {

namespace fs = std::filesystem;

// Without a display: one line that says so, and the picture that the window would have shown.
int render_instead(const WindowOptions& options, const std::string& reason) {
  const fs::path picture = "viete.png";
  std::fprintf(stderr, "viete: no window (%s), writing a picture to %s instead\n", reason.c_str(),
               picture.c_str());
  ViewerOptions viewer_options;
  viewer_options.samples = 4;
  viewer_options.scale = options.scale > 0 ? options.scale : 1;
  viewer_options.size = {1440, 900};
  viewer_options.bindings = {.folder = bindings_folder(), .named = options.binding};
  OffscreenViewer offscreen(viewer_options);
  scene::Workspace& workspace = offscreen.viewer().workspace();
  set_settings(workspace.document, options);
  if (!scene::open_now(workspace,
                       {scene::OpenRequest::What::model, {options.model, options.cage, options.pose}})) {
    throw base::Error("", workspace.messages.all().back().text);
  }
  offscreen.settle();
  render::write_png(picture, offscreen.viewer().picture());
  return exit_ok;
}

int view(WindowOptions options) {
  scene::Document tried;
  set_settings(tried, options);  // contradictions are told before anything opens
  if (options.model.empty()) {
    const BundledModel bundled = bundled_model();
    options.model = bundled.model;
    options.cage = bundled.cage;
  }
  std::string reason;
  if (run_window(options, reason)) return exit_ok;
  return render_instead(options, reason);
}

}  // namespace

void add_view_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("view", "Open the viewer (this is what `viete` alone does)");
  auto options = std::make_shared<WindowOptions>();
  command->add_option(
      "MODEL", options->model,
      "Mesh to deform (OBJ, PLY, OFF, STL), or a session (.viete); default: the bundled dragon");
  command->add_option("CAGE", options->cage, "Cage around it");
  command->add_option("--pose", options->pose, "Posed version of the cage, same vertices in the same order");
  add_method_option(*command, options->method);
  add_weighting_options(*command, options->weighting);
  add_binding_option(*command, options->binding);
  command
      ->add_option("--scale", options->scale,
                   "Device pixels per logical pixel; default: what the display says")
      ->check(CLI::Range(0.5, 4.0));
  command->add_option("--frames", options->frames, "Close after so many frames")
      ->check(CLI::NonNegativeNumber);
  command->callback([command, options, &action] {
    check_session_stands_alone(options->model, options->cage, options->pose);
    for (const char* setting : {"--method", "--coordinates", "--reach"}) {
      if (scene::is_session(options->model) && command->count(setting) > 0)
        throw CLI::ValidationError(setting, "the session " + options->model.string() +
                                                " has its own: leave it out, and change it in the window");
    }
    action = [options] { return view(*options); };
  });
}

}  // namespace viete::app
