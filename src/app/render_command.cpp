// viete render MODEL [CAGE] [--pose POSE] -o out.png, or viete render SESSION -o out.png: renders a picture
// without a window.
#include <filesystem>
#include <memory>
#include <utility>

#include "app/command_line.h"
#include "app/help.h"
#include "app/inputs.h"
#include "app/offscreen_viewer.h"
#include "app/options.h"
#include "base/error.h"
#include "mesh/formats/source.h"

namespace viete::app {

namespace {

struct RenderOptions {
  Inputs inputs{Use::picture};
  std::filesystem::path output;
  PictureOptions picture;
  bool force = false;
};

int render(const RenderOptions& options) {
  if (mesh::extension_of(options.output) != "png")
    throw base::Error(options.output.string(), "pictures can only be written as PNG",
                      "use the extension .png");
  const auto offscreen = viewer_of(options.picture, open(options.inputs, scene::check_drawable,
                                                         {options.output, Content::picture, options.force}));
  offscreen->settle();
  Viewer& viewer = offscreen->viewer();
  print_messages(viewer.workspace());
  render::write_png(options.output, viewer.picture());
  return exit_ok;
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("render", "Render a picture without a window");
  auto o = std::make_shared<RenderOptions>();
  add_input_options(*command, o->inputs);
  add_file_option(*command, "-o,--output", o->output, "PNG file to write")->required();
  add_force_option(*command, o->force);
  add_picture_options(*command, o->picture);
  command->add_flag("--transparent", o->picture.viewer.transparent, "Transparent background");
  add_examples(*command, {"render model.obj cage.obj --pose pose.obj -o picture.png",
                          "render scene.viete --look front --map area -o picture.png"});
  command->callback([o, command, &action] {
    check_usage(o->inputs);
    take_given(*command, o->picture);
    action = [o] { return render(*o); };
  });
}

}  // namespace viete::app
