// viete render MODEL [CAGE] [--pose POSE] -o FILE, or viete render SESSION -o FILE: renders a picture.
#include <memory>

#include "app/inputs.h"
#include "app/offscreen_viewer.h"
#include "base/error.h"
#include "base/file_bytes.h"

namespace viete::app {

namespace {

struct RenderOptions {
  Inputs inputs{Use::picture};
  Output output{Content::picture};
  PictureOptions picture;
};

int render(const RenderOptions& options) {
  if (base::extension_of(options.output.file) != "png")
    throw base::Error(options.output.file.string(), "pictures can only be written as PNG",
                      "use the extension .png");
  const auto offscreen =
      viewer_of(options.picture, open(options.inputs, files::check_drawable, options.output));
  offscreen->settle();
  Viewer& viewer = offscreen->viewer();
  print_messages(viewer.workspace());
  render::write_png(options.output.file, viewer.picture());
  return exit_ok;
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("render", "Render a picture without a window");
  auto o = std::make_shared<RenderOptions>();
  add_input_options(*command, o->inputs);
  add_output_options(*command, o->output, "PNG file to write");
  add_picture_options(*command, o->picture);
  using document::Timeline;
  auto* frame = command->add_option_function<int>(
      "--frame", [o](int frame) { o->picture.frame = frame; }, "Frame of the timeline");
  whole_in_range(frame, Timeline::least_frame, Timeline::largest_frame)->default_str("the session's frame");
  command->add_flag("--transparent", o->picture.viewer.transparent, "Make the background transparent");
  add_examples(*command, {"render model.obj cage.obj --pose pose.obj -o picture.png",
                          "render scene.viete --look front --map area -o picture.png"});
  command->callback([o, &action] {
    check_usage(o->inputs);
    action = [o] { return render(*o); };
  });
}

}  // namespace viete::app
