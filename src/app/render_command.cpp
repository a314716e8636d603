// viete render MODEL [CAGE] [--pose POSE] -o out.png, or viete render SESSION -o out.png: a picture without a
// window.
#include <filesystem>
#include <memory>
#include <utility>

#include "app/command_line.h"
#include "app/inputs.h"
#include "app/options.h"
#include "app/output.h"
#include "app/passes.h"
#include "app/picture_options.h"
#include "app/vector_picture.h"
#include "base/atomic_file.h"
#include "base/choice.h"
#include "base/error.h"
#include "mesh/formats/source.h"

namespace viete::app {

namespace {

struct RenderOptions {
  Inputs inputs{Use::picture};
  std::filesystem::path output;
  PictureOptions picture;
  render::Pass pass = render::Pass::none;
  bool force = false;
};

Content content_of(const RenderOptions& options) {
  const std::string extension = mesh::extension_of(options.output);
  const bool told = options.pass != render::Pass::none, depth = options.pass == render::Pass::depth;
  if (extension == "png") return Content::picture;
  if (extension == "svg" && !told) return Content::svg;
  if (extension == "pfm" && depth) return Content::distances;
  throw base::Error(options.output.string(), "pictures are not written in this format",
                    depth  ? "give the file the extension .png, or .pfm for distances"
                    : told ? "give the file the extension .png"
                           : "give the file the extension .png, or .svg for a cage of lines");
}

int render(const RenderOptions& options) {
  const Content content = content_of(options);
  const auto offscreen = viewer_of(
      options.picture, open(options.inputs, scene::check_drawable, {options.output, content, options.force}));
  offscreen->settle();
  Viewer& viewer = offscreen->viewer();
  print_messages(viewer.workspace());
  if (options.pass != render::Pass::none) {
    const std::string note = write_pass(viewer, options.pass, options.output);
    if (!note.empty()) print_notes({note});
  } else if (content == Content::svg) {
    base::replace_file(options.output, svg_of(viewer, options.picture.viewer.cage_width));
  } else {
    render::write_png(options.output, viewer.picture());
  }
  return exit_ok;
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("render", "Render a picture without a window");
  auto o = std::make_shared<RenderOptions>();
  add_input_options(*command, o->inputs);
  add_file_option(*command, "-o,--output", o->output, "PNG or SVG file to write")->required();
  add_force_option(*command, o->force);
  add_picture_options(*command, o->picture);
  std::vector<std::string> passes;
  for (const base::Choice& choice : choices(render::Pass::none)) passes.emplace_back(choice.word);
  auto* pass = command->add_option_function<std::string>(
      "--pass", [o](const std::string& word) { o->pass = *base::value_of_word<render::Pass>(word); },
      "What is told of the model instead: depth (PNG, or distances as PFM), normals, triangles or occlusion");
  one_of(pass, passes)->default_str("none");
  command->add_flag("--transparent", o->picture.viewer.transparent, "Without a background");
  command->callback([o, command, &action] {
    check_usage(o->inputs);
    take_given(*command, o->picture);
    o->picture.cage |= mesh::extension_of(o->output) == "svg";  // which is a picture of it
    // What is told of a pixel is that of one place.
    if (o->pass != render::Pass::none && o->pass != render::Pass::occlusion) o->picture.viewer.samples = 0;
    const bool is_split = !o->picture.compare.empty();
    if (is_split && (o->pass != render::Pass::none || mesh::extension_of(o->output) == "svg"))
      throw CLI::ParseError("--compare goes with a PNG of how things look alone", exit_usage);
    action = [o] { return render(*o); };
  });
}

}  // namespace viete::app
