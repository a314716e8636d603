// viete animate SESSION -o PATTERN --frames A-B: the deformed model at the frames of a timeline, as files.
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/command_line.h"
#include "app/inputs.h"
#include "app/options.h"
#include "app/output.h"
#include "app/terminal_progress.h"
#include "base/error.h"
#include "base/printable.h"
#include "base/quantity.h"
#include "mesh/source.h"
#include "scene/animation_export.h"

namespace viete::app {

namespace {

struct FrameRange {
  int first, last;
};

struct AnimateOptions {
  Inputs inputs{Use::animation};
  std::filesystem::path output;
  std::optional<FrameRange> frames;
  std::optional<double> rate;
  int step = 1;
  double tolerance = 1e-4;
  bool every_frame = false, straight = false, force = false;
  mesh::Digits digits;
};

// "1-48", "-10--1", "7". Nothing for other words.
std::optional<FrameRange> frame_range(const std::string& text) {
  FrameRange range{};
  const char *at = text.data(), *const end = at + text.size();
  const auto first = std::from_chars(at, end, range.first);
  if (first.ec != std::errc()) return std::nullopt;
  range.last = range.first;
  if (first.ptr != end) {
    if (*first.ptr != '-') return std::nullopt;
    const auto last = std::from_chars(first.ptr + 1, end, range.last);
    if (last.ec != std::errc() || last.ptr != end) return std::nullopt;
  }
  using scene::Timeline;
  const bool fits = Timeline::least_frame <= range.first && range.first <= range.last &&
                    range.last <= Timeline::largest_frame;
  return fits ? std::optional(range) : std::nullopt;
}

void add_frames_option(CLI::App& command, std::optional<FrameRange>& frames) {
  command
      .add_option_function<std::string>(
          "--frames",
          [&frames](const std::string& text) {
            frames = frame_range(text);
            if (!frames)
              throw CLI::ValidationError("--frames", "needs first-last, such as 1-48, not " + text);
          },
          "First and last frame; frames are independent, so that several programs can share them")
      ->option_text("A-B")
      ->default_str("what plays in the session");
}

scene::AnimationExport export_of(const AnimateOptions& options, const scene::Opened& opened) {
  scene::AnimationExport what = scene::animation_export_of(*opened.document, options.output);
  if (opened.session && opened.session->camera) what.model.up = opened.session->camera->up;
  what.model.digits = options.digits;
  if (options.frames) what.first = options.frames->first, what.last = options.frames->last;
  what.rate = options.rate.value_or(what.rate);
  what.step = options.step;
  what.tolerance = options.tolerance;
  what.every_frame = options.every_frame;
  what.timeline.straight |= options.straight;
  what.replaces_foreign = options.force;
  return what;
}

void check_output(const AnimateOptions& options) {
  const std::string extension = mesh::extension_of(options.output);
  if (base::NumberedName::is_pattern(options.output) || !scene::is_animation_format(extension)) return;
  check_output(options.output, Content::animation, files_read(options.inputs), options.force);
}

void say(const std::filesystem::path& file, const scene::AnimationReport& report) {
  std::string text = report.summary;
  if (report.there > 0) text += "; " + base::with_thousands(report.there) + " of them were there already";
  std::printf("%s: %s\n", base::printable(file.string()).c_str(), text.c_str());
}

int write_models(const AnimateOptions& options) {
  check_output(options);
  const scene::Opened opened = open(options.inputs, scene::check_deformable);
  print_notes(opened.warnings);
  const scene::AnimationExport what = export_of(options, opened);
  scene::check_animation_export(what);
  TerminalProgress work("Writing " + options.output.filename().string());
  const scene::AnimationReport report = scene::write_animation(what, &work.progress());
  print_notes(report.notes);
  say(options.output, report);
  return exit_ok;
}

int animate(const AnimateOptions& options) {
  try {
    return write_models(options);
  } catch (const base::Cancelled&) {
    throw base::Error(options.output.string(), "stopped",
                      "what is whole stays; the same command goes on from there");
  }
}

}  // namespace

void add_animate_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("animate", "Write the frames of a session's timeline");
  auto o = std::make_shared<AnimateOptions>();
  add_input_options(*command, o->inputs);
  add_file_option(*command, "-o,--output", o->output,
                  "File to write; the extension chooses the format: .pc2 and .mdd (point caches), .glb and "
                  ".gltf (morph targets), or numbered models such as frame_####.obj")
      ->required();
  add_frames_option(*command, o->frames);
  auto* step = command->add_option("--step", o->step, "Every so many frames; of glTF, morph targets there");
  whole_in_range(step, 1, 1'000'000)->default_str("1; of glTF, as many as --tolerance needs");
  auto* rate = command->add_option("--rate", o->rate, "Frames a second");
  in_range(rate, scene::Timeline::least_rate, scene::Timeline::largest_rate)
      ->default_str("as in the session");
  auto* tolerance = command->add_option(
      "--tolerance", o->tolerance,
      "Of morph targets: how far the lines between them may lead from the motion, in diagonals of the model");
  in_range(tolerance, 1e-7, 1)->default_str("0.0001");
  command->add_flag("--straight", o->straight, "The cage's vertices go straight from key to key");
  add_digits_option(*command, o->digits);
  add_force_option(*command, o->force);
  command->callback([o, command, &action] {
    check_usage(o->inputs);
    o->every_frame = command->count("--step") > 0;
    action = [o] { return animate(*o); };
  });
}

}  // namespace viete::app
