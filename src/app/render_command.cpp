// viete render MODEL [CAGE] [--pose POSE] -o out.png, or viete render SESSION -o out.png: a picture without a
// window.
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "app/command_line.h"
#include "app/inputs.h"
#include "app/offscreen_viewer.h"
#include "app/options.h"
#include "app/output.h"
#include "base/error.h"
#include "mesh/source.h"

namespace viete::app {

namespace {

struct RenderOptions {
  Inputs inputs{Use::picture};
  std::filesystem::path output;
  ViewerOptions viewer{.samples = 4, .bindings = {.folder = bindings_folder()}};
  bool panels = false, light = false, error_map = false, no_cage = false, wireframe = false, no_grid = false;
  std::string look = "home", shading;
  bool force = false, size_given = false, look_given = false;
};

const std::map<std::string, scene::StandardView> looks = {
    {"home", scene::StandardView::home},    {"front", scene::StandardView::front},
    {"back", scene::StandardView::back},    {"left", scene::StandardView::left},
    {"right", scene::StandardView::right},  {"top", scene::StandardView::top},
    {"bottom", scene::StandardView::bottom}};

// Flags switch on top of what the session, or else the default for pictures, has.
scene::ViewOptions view_of(const RenderOptions& options, const std::optional<scene::Session>& session) {
  scene::ViewOptions view = session ? session->view : scene::ViewOptions{.panels = false, .hints = false};
  view.panels |= options.panels;
  view.dark &= !options.light;
  view.cage &= !options.no_cage;
  view.wireframe |= options.wireframe;
  view.error_map |= options.error_map;
  view.grid &= !options.no_grid;
  const auto all = scene::all_shadings();
  const auto asked = std::ranges::find(all, options.shading, &scene::ShadingChoice::word);
  if (asked != all.end()) view.shading = static_cast<scene::Shading>(asked - all.begin());
  return view;
}

void set_up(scene::Workspace& workspace, scene::Opened&& opened, const RenderOptions& options) {
  const std::optional<scene::Session> session = opened.session;
  scene::take(workspace, std::move(opened));
  workspace.view = view_of(options, session);
  workspace.attended = false;
}

// A session has its own camera, which another look replaces.
void aim(Viewer& viewer, bool has_camera, const RenderOptions& options) {
  viewer.frame(0);  // places the viewport that framing needs
  if (has_camera && !options.look_given) return;
  scene::Workspace& workspace = viewer.workspace();
  workspace.camera.look(looks.at(options.look));
  workspace.camera.animate(1);
  scene::frame_all(workspace, false);
}

void check_output(const RenderOptions& options) {
  if (mesh::extension_of(options.output) != "png") {
    throw base::Error(options.output.string(), "pictures are written as PNG only",
                      "give the file the extension .png");
  }
  auto inputs = files_read(options.inputs);
  inputs.push_back(options.viewer.bindings.named);
  check_output(options.output, Content::picture, inputs, options.force);
}

int render(const RenderOptions& options) {
  check_output(options);
  scene::Opened opened = open(options.inputs, scene::check_drawable);
  const bool has_camera = opened.session && opened.session->camera;
  ViewerOptions viewer_options = options.viewer;
  if (opened.session && opened.session->window && !options.size_given)
    viewer_options.size = *opened.session->window;
  OffscreenViewer offscreen(viewer_options);
  scene::Workspace& workspace = offscreen.viewer().workspace();
  set_up(workspace, std::move(opened), options);
  aim(offscreen.viewer(), has_camera, options);
  offscreen.settle();
  if (const auto& cage = workspace.document.cage) print_notes(cage->warnings);
  const auto& messages = workspace.messages.all();
  for (const auto& message : messages) {
    if (message.severity == scene::Severity::error) throw base::Error("", message.text);
    print_notes({message.text});
  }
  print_notes(workspace.pose_notes);
  render::write_png(options.output, offscreen.viewer().picture());
  return exit_ok;
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("render", "Render a picture without a window");
  auto o = std::make_shared<RenderOptions>();
  add_input_options(*command, o->inputs);
  add_file_option(*command, "-o,--output", o->output, "PNG file to write")->required();
  add_force_option(*command, o->force);
  add_size_option(*command, o->viewer.size);
  auto* scale = command->add_option("--scale", o->viewer.scale, "Device pixels per logical pixel");
  in_range(scale, 0.5, 4)->default_str("1");
  add_binding_option(*command, o->viewer.bindings.named);
  auto* look = command->add_option("--look", o->look, "home, front, back, left, right, top or bottom");
  one_of(look, {"home", "front", "back", "left", "right", "top", "bottom"})->default_str("home");
  auto* shading = command->add_option("--shading", o->shading,
                                      "clay, porcelain, jade, file (as it says), checker, normals or zebra");
  one_of(shading, {"clay", "porcelain", "jade", "file", "checker", "normals", "zebra"})->default_str("file");
  command->add_flag("--panels", o->panels, "With the panels");
  command->add_flag("--light", o->light, "Light theme");
  command->add_flag("--wireframe", o->wireframe, "With the edges of the mesh");
  command->add_flag("--error-map", o->error_map, "With the error of the exponential as colours on the mesh");
  command->add_flag("--no-cage", o->no_cage, "Without the cage");
  command->add_flag("--no-grid", o->no_grid, "Without the ground grid");
  command->callback([o, command, &action] {
    check_usage(o->inputs);
    o->size_given = command->count("--size") > 0;
    o->look_given = command->count("--look") > 0;
    action = [o] { return render(*o); };
  });
}

}  // namespace viete::app
