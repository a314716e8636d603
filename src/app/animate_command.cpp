// viete animate SESSION -o PATTERN --frames A-B: exports the deformed model at frames of a timeline.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/child_process.h"
#include "app/film.h"
#include "app/inputs.h"
#include "app/offscreen_viewer.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "base/text.h"
#include "files/animation_import.h"

namespace viete::app {

namespace {

struct FrameRange {
  int first, last;
};

struct AnimateOptions {
  Inputs inputs{Use::animation};
  Output output{Content::animation};
  std::optional<FrameRange> frames;
  std::optional<double> rate;
  int step = 1;
  double tolerance = 1e-4;
  bool no_normals = false, linear = false, turntable = false;
  std::filesystem::path keys;
  FilmQuality quality = FilmQuality::medium;
  PictureOptions picture;
};

// Parses "1-48", "-10--1" or "7". Returns nullopt for other text.
std::optional<FrameRange> frame_range(const std::string& text) {
  using document::Timeline;
  FrameRange range{};
  int end = 0;
  const int read = std::sscanf(text.c_str(), "%9d%n-%9d%n", &range.first, &end, &range.last, &end);
  if (read == 1) range.last = range.first;
  const bool fits = read > 0 && static_cast<std::size_t>(end) == text.size() &&
                    Timeline::least_frame <= range.first && range.first <= range.last &&
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
              throw CLI::ValidationError("--frames", "needs FIRST-LAST, such as 1-48, not " + text);
          },
          "First and last frame")
      ->option_text("A-B")
      ->default_str("the session's frames");
}

// Called twice: before reading, with the files of the command line, and after reading, with all read files.
void check_output(const AnimateOptions& options, FilesInUse files, const files::FrameSteps& frames = {}) {
  const std::string extension = base::extension_of(options.output.file);
  const bool numbered = base::NumberedName::is_pattern(options.output.file);
  if (!numbered && !files::is_animation_format(extension) && !files::is_film(options.output.file)) return;
  check_output(options.output.file, frames, files, force_of(options.output.force));
}

// Opens the document and applies the options to the timeline.
files::Opened opened_for(const AnimateOptions& options, void (*check)(const files::Opened&)) {
  files::Opened opened = open(options.inputs, check);
  document::Document& document = *opened.document;
  document::Timeline& timeline = document.changed_timeline();
  timeline.rate = options.rate.value_or(timeline.rate);
  timeline.linear |= options.linear;
  if (!options.keys.empty()) {
    if (!document.has_cage())
      throw base::Error(options.inputs.model.string(), "the session has no cage, but keys need a cage",
                        "open it in the window and add a cage");
    files::ImportedKeys keys =
        files::read_keys(options.keys, *document.cage(), {timeline.first, timeline.rate});
    opened.warnings.insert(opened.warnings.end(), keys.warnings.begin(), keys.warnings.end());
    for (auto& file : keys.files) opened.also_read.push_back({std::move(file), document::the_keys});
    timeline.keys = std::move(keys.keys);
    timeline.first = timeline.keys.front().frame;
    timeline.last = timeline.keys.back().frame;
  }
  if (options.frames) {
    timeline.first = options.frames->first;
    timeline.last = options.frames->last;
  }
  check_output(options, files::files_of(opened), {timeline.first, timeline.last, options.step});
  return opened;
}

files::AnimationExport export_of(const AnimateOptions& options, const files::Opened& opened) {
  files::AnimationExport what = files::animation_export_of(*opened.document, options.output.file);
  if (opened.session && opened.session->camera) what.model.up = opened.session->camera->up;
  what.model.digits = options.output.digits;
  what.step = options.step;
  what.tolerance = options.tolerance;
  what.normals = !options.no_normals;
  what.force = force_of(options.output.force);
  return what;
}

int write_models(const AnimateOptions& options) {
  const files::Opened opened = opened_for(options, files::check_deformable);
  print_notes(opened.warnings);
  const files::AnimationExport what = export_of(options, opened);
  files::check_animation_export(what);
  return write_frames(options.output, what);
}

PictureRun picture_run(const AnimateOptions& options, const document::Timeline& timeline) {
  PictureRun run{options.output.file,           {}, timeline.rate, options.step, options.turntable,
                 force_of(options.output.force)};
  for (int frame = timeline.first; frame <= timeline.last; frame += options.step) run.frames.push_back(frame);
  return run;
}

files::Opened opened_for_pictures(const AnimateOptions& options) {
  files::Opened opened = opened_for(options, files::check_drawable);
  if (opened.document->timeline().empty() && !options.turntable)
    throw base::Error(options.inputs.model.string(), "the timeline has no keys, so nothing moves",
                      "set keys on the timeline and save the session, or add --turntable");
  return opened;
}

// Draws the pictures of `run`. Returns notes.
std::vector<std::string> draw(const AnimateOptions& options, files::Opened&& opened, const PictureRun& run,
                              base::Progress& progress) {
  PictureOptions picture = options.picture;
  picture.viewer.probe = picture.panels;
  const auto offscreen = viewer_of(picture, std::move(opened));
  std::vector<std::string> notes = write_pictures(*offscreen, run, progress);
  print_messages(offscreen->viewer().workspace());
  return notes;
}

int write_pictures(const AnimateOptions& options) {
  if (!base::NumberedName::is_pattern(options.output.file))
    throw base::Error(options.output.file.string(), "a single picture cannot show an animation",
                      "write numbered pictures: frame_####.png");
  files::Opened opened = opened_for_pictures(options);
  base::check_replaceable(base::NumberedName(options.output.file).file(1));
  const PictureRun run = picture_run(options, opened.document->timeline());
  auto work = std::make_unique<TerminalProgress>("Drawing " + options.output.file.filename().string());
  std::vector<std::string> notes = draw(options, std::move(opened), run, work->progress());
  work.reset();                                                   // removes the progress line
  const bool has_gaps = run.step != 1 || run.frames.front() < 0;  // ffmpeg does not support these numbers
  if (!has_gaps) notes.push_back(ffmpeg_command(run));
  print_notes(notes);
  print_summary(options.output, base::counted(run.frames.size(), "picture"));
  return exit_ok;
}

int write_film(const AnimateOptions& options) {
  const std::filesystem::path& film = options.output.file;
  if (base::NumberedName::is_pattern(film))
    throw base::Error(film.string(), "a film stores all frames in one file", "remove #### from the name");
  check_film_maker(film);
  files::Opened opened = opened_for_pictures(options);
  const ScratchFolder scratch;
  PictureRun run = picture_run(options, opened.document->timeline());
  run.file = scratch.path() / "frame_######.png";
  auto work = std::make_unique<TerminalProgress>("Making " + film.filename().string());
  work->progress().section(0, 0.8);
  const std::vector<std::string> notes = draw(options, std::move(opened), run, work->progress());
  for (std::size_t i = 0; i < run.frames.size(); ++i)
    std::filesystem::rename(base::NumberedName(run.file).file(run.frames[i]),
                            scratch.path() / base::formatted("%06zu.png", i + 1));
  work->progress().section(0.8, 1);
  make_film(film, scratch.path(), run.frames.size(), run.rate / run.step, options.quality, work->progress());
  work.reset();  // removes the progress line
  print_notes(notes);
  print_summary(options.output, base::counted(run.frames.size(), "picture"));
  return exit_ok;
}

int animate(const AnimateOptions& options) {
  FilesInUse named = files_read(options.inputs);
  named.add(options.keys, document::the_keys);
  check_output(options, std::move(named));
  if (files::is_film(options.output.file)) return write_film(options);
  return base::extension_of(options.output.file) == "png" ? write_pictures(options) : write_models(options);
}

}  // namespace

void add_animate_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("animate", "Export the animation of a session");
  auto o = std::make_shared<AnimateOptions>();
  add_input_options(*command, o->inputs);
  add_output_options(
      *command, o->output,
      "File to write: .pc2, .mdd, .glb, .gltf, a film (.mp4, .webm, .gif), or numbered meshes or pictures "
      "(frame_####.obj, .png)");
  add_split_option(*command, o->output);
  add_file_option(*command, "--keys", o->keys, "Keys: numbered cages, point cache or animated glTF");
  add_frames_option(*command, o->frames);
  auto* step = command->add_option("--step", o->step, "Export every Nth frame");
  whole_in_range(step, 1, 1'000'000)->default_str("1");
  auto* rate = command->add_option("--rate", o->rate, "Frame rate");
  in_range(rate, document::Timeline::least_rate, document::Timeline::largest_rate)
      ->default_str("as in the session");
  auto* tolerance =
      command->add_option("--tolerance", o->tolerance, "Morph targets: largest error in model diagonals");
  in_range(tolerance, 1e-7, 1)->default_str("0.0001");
  command->add_flag("--no-normals", o->no_normals, "glTF: omit normals, which halves the file size");
  command->add_flag("--linear", o->linear, "Interpolate vertex positions linearly");
  add_choice<FilmQuality>(*command, "--quality", "Films: quality, low, medium or high", o->quality)
      ->default_str("medium");
  command->add_flag("--turntable", o->turntable, "Pictures: orbit the camera once around the model");
  add_picture_options(*command, o->picture);
  add_examples(*command,
               {"animate scene.viete -o motion.glb", "animate scene.viete --turntable -o turn.mp4"});
  command->callback([o, &action] {
    check_usage(o->inputs);
    if (!o->inputs.session() && o->keys.empty() && !o->turntable) throw CLI::RequiredError("--keys");
    action = [o] {
      return run_cancellable(
          o->output, [&] { return animate(*o); }, "files written so far are complete");
    };
  });
}

}  // namespace viete::app
