// viete replay SCRIPT [-o FILE]: what hands did, once more: in a window, or at once, into a session or
// picture.
#include <filesystem>
#include <memory>

#include "app/command_line.h"
#include "app/inputs.h"
#include "app/offscreen_viewer.h"
#include "app/options.h"
#include "app/output.h"
#include "app/script_player.h"
#include "app/window_viewer.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "mesh/formats/source.h"
#include "scene/workspace/saving.h"

namespace viete::app {

namespace {

struct ReplayOptions {
  std::filesystem::path script, output;
  float scale = 1;
  bool force = false;
};

void write(Viewer& viewer, const std::filesystem::path& output) {
  scene::Workspace& w = viewer.workspace();
  if (mesh::extension_of(output) == "png") return render::write_png(output, viewer.picture());
  if (!w.document.model.surface)
    throw base::Error(output.string(),
                      "no model is open at the end of the script, so there is nothing to save");
  base::replace_file(output, scene::session_text(scene::session_of(w), output));
}

int play_into(const ReplayOptions& options) {
  const bool picture = mesh::extension_of(options.output) == "png";
  if (!picture && !scene::is_session(options.output))
    throw base::Error(options.output.string(), "a replay gives a session or a picture",
                      "give the file the extension .viete or .png");
  Script script = read_script(options.script);
  FilesInUse read;
  read.add(options.script, "the script");
  for (const auto& file : script.open) read.add(file, "what the script opens");
  check_output(options.output, picture ? Content::picture : Content::session, read, options.force);
  ViewerOptions viewer_options{.size = script.window, .scale = options.scale, .probe = false};
  OffscreenViewer offscreen(viewer_options);
  Viewer& viewer = offscreen.viewer();
  viewer.workspace().attended = viewer.workspace().tools = false;
  ScriptPlayer player(std::move(script), viewer);
  player.open();
  offscreen.settle();
  for (const auto& message : viewer.workspace().messages.all())
    if (message.severity == scene::Severity::error) throw base::Error("", message.text);
  play_at_once(player, viewer);
  offscreen.settle();
  write(viewer, options.output);
  return exit_ok;
}

int replay(const ReplayOptions& options) {
  if (!options.output.empty()) return play_into(options);
  read_script(options.script);  // before a window opens
  WindowOptions window;
  window.script = options.script;
  std::string reason;
  if (run_window(window, reason)) return exit_ok;
  throw base::Error("", "no window (" + reason + ")",
                    "name a result with -o: a session or a picture, which need none");
}

}  // namespace

void add_replay_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("replay", "Do again what Help, Record has written");
  auto o = std::make_shared<ReplayOptions>();
  add_file_option(*command, "SCRIPT", o->script, "What hands did")->required();
  add_file_option(*command, "-o,--output", o->output,
                  "Without a window, as fast as it goes: a session, or a picture (PNG), of its end");
  add_force_option(*command, o->force);
  in_range(command->add_option("--scale", o->scale, "Device pixels per logical pixel, of a picture"), 0.5, 4)
      ->default_str("1");
  command->callback([o, &action] { action = [o] { return replay(*o); }; });
}

}  // namespace viete::app
