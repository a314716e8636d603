// viete mix REST --shape FILE=0.5 ... -o OUT: combines weighted shapes of a model.
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/inputs.h"
#include "base/error.h"
#include "base/text.h"
#include "document/animation.h"
#include "document/document_state.h"
#include "foreign/read.h"

namespace viete::app {

namespace {

using document::PoseLibrary;

struct Share {
  std::filesystem::path file;
  double weight;
  std::string name = {};
};

struct MixOptions {
  std::filesystem::path rest;
  Output output;
  std::vector<Share> shares;
  bool linear = false;
};

// Parses text such as "smile.obj=0.5".
Share share_of(const std::string& text) {
  const auto equals = text.rfind('=');
  double weight = 0;
  const char* const end = text.data() + text.size();
  const bool read = equals != text.npos && equals > 0 &&
                    std::from_chars(text.data() + equals + 1, end, weight).ptr == end &&
                    equals + 1 < text.size();
  if (!read || !(weight >= PoseLibrary::least_weight && weight <= PoseLibrary::largest_weight))
    throw CLI::ValidationError("--shape", "needs FILE=WEIGHT, such as smile.obj=0.5, with a weight from " +
                                              std::to_string(int(PoseLibrary::least_weight)) + " to " +
                                              std::to_string(int(PoseLibrary::largest_weight)) + ", not " +
                                              text);
  return {text.substr(0, equals), weight};
}

// If the file does not exist, splits a name such as "face.glb:smile" into the file and the name of a shape.
void split_name(Share& share) {
  const std::string text = share.file.string();
  std::error_code ignored;
  if (std::filesystem::exists(share.file, ignored)) return;
  for (auto colon = text.find(':'); colon != text.npos; colon = text.find(':', colon + 1)) {
    share = {text.substr(0, colon), share.weight, text.substr(colon + 1)};
    if (std::filesystem::exists(share.file, ignored)) return;
  }
}

document::SharedShape shape_of(const Share& share, const std::vector<document::NamedShape>& shapes) {
  if (share.name.empty() && shapes.size() == 1) return shapes.front().shape;
  constexpr std::size_t most = 12;
  std::vector<std::string> names;
  for (const document::NamedShape& shape : shapes) {
    if (shape.name == share.name) return shape.shape;
    names.push_back(shape.name);
  }
  throw base::Error(
      share.file.string(),
      share.name.empty() ? "it contains several shapes" : "it contains no shape named " + share.name,
      "append one of these names after a colon: " + base::joined(names, ", ", most));
}

int write_mix(MixOptions options) {
  std::vector<std::filesystem::path> files;
  for (Share& share : options.shares) {
    split_name(share);
    files.push_back(share.file);
  }
  const OpenedShapes opened = open_shapes(options.rest, files, options.output);
  std::vector<document::ShapeTerm> terms;
  for (std::size_t i = 0; i < files.size(); ++i)
    terms.push_back({shape_of(options.shares[i], opened.of_files[i]), options.shares[i].weight});
  files::Export what = export_to(options.output, opened.model);
  std::vector<std::string> notes;
  std::optional<TerminalProgress> work(options.output.task());
  base::WorkerPool pool;
  const shapes::ShapeSpace space(*what.model, pool, &work->progress());
  what.shape = document::mixed(space, terms, options.linear, pool, &notes);
  for (auto& note : write_shape(what, "the mix", &work->progress())) notes.push_back(std::move(note));
  work.reset();  // removes the progress line
  print_notes(notes);
  return exit_ok;
}

}  // namespace

void add_mix_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("mix", "Combine weighted shapes of a model");
  auto o = std::make_shared<MixOptions>();
  command->add_option("REST", o->rest, foreign::a_mesh())->required();
  command
      ->add_option_function<std::vector<std::string>>(
          "--shape",
          [o](const std::vector<std::string>& texts) {
            for (const auto& text : texts) o->shares.push_back(share_of(text));
          },
          "Shape with the same faces, and its weight: smile.obj=0.5, or face.glb:smile=0.5 if the file "
          "contains several shapes; repeatable")
      ->allow_extra_args(false)
      ->option_text("FILE=WEIGHT ...")
      ->required();
  command->add_flag("--linear", o->linear, "Combine vertex positions linearly");
  add_output_options(*command, o->output);
  add_examples(*command, {"mix rest.obj --shape smile.obj=0.5 -o mixed.obj",
                          "mix rest.obj --shape face.glb:smile=1 --shape sad.obj=-0.2 -o mix.ply"});
  command->callback(
      [o, &action] { action = [o] { return run_cancellable(o->output, [&] { return write_mix(*o); }); }; });
}

}  // namespace viete::app
