// viete cage MODEL -o CAGE: generates a cage around a model.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/inputs.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/text.h"
#include "cages/capture.h"
#include "cages/make.h"
#include "cages/soundness.h"
#include "foreign/read.h"
#include "formats/format_table.h"
#include "formats/write.h"

namespace viete::app {

namespace {

struct CageOptions {
  std::filesystem::path model;
  Output output;
  cages::Wish wish;
};

// Parses text such as "2x3x2". If the text is not valid, returns an error message, otherwise an empty text.
std::string take_cells(const std::string& text, std::array<std::size_t, 3>& cells) {
  std::array<std::size_t, 3> read{};
  int end = 0;
  const int found = std::sscanf(text.c_str(), "%3zux%3zux%3zu%n", &read[0], &read[1], &read[2], &end);
  const bool in_range = found == 3 && static_cast<std::size_t>(end) == text.size() &&
                        std::ranges::all_of(read, [](auto n) { return n >= 1 && n <= cages::most_cells; });
  if (!in_range)
    return "needs three whole numbers from 1 to " + std::to_string(cages::most_cells) +
           ", such as 2x3x2, not " + text;
  cells = read;
  return {};
}

void print(const cages::Made& made, bool keeps_quads, double seconds) {
  const std::size_t triangles = made.surface.triangles.size();
  const std::size_t quads = keeps_quads ? triangles - made.surface.polygon_count() : 0;
  std::printf("made a cage of %s", base::counted(triangles, "triangle").c_str());
  if (quads > 0) std::printf(" (%s of them in quads)", base::with_thousands(2 * quads).c_str());
  if (made.mirror) std::printf(", symmetric");
  std::printf(" in %s\n", base::milliseconds(1e3 * seconds).c_str());
}

// Throws base::Error if the cage is no longer valid after coordinates are rounded to float.
void check_rounded(const std::filesystem::path& file, mesh::Surface cage, const mesh::Surface& model,
                   base::WorkerPool& pool) {
  bool fits = true;
  for (mesh::Point& p : cage.positions)
    for (double& x : p) {
      x = static_cast<float>(x);
      fits = fits && std::isfinite(x);
    }
  if (fits && cages::soundness(cage, model, pool).sound()) return;
  throw base::Error(file.string(), "glTF stores coordinates with 7 digits, which are too few for this cage",
                    "write it as " + formats::format_extensions(formats::keeps_order));
}

// Throws if an option for another kind of cage is used.
void refuse_unused_options(const CLI::App& command, const cages::Wish& wish) {
  std::vector<std::string> idle = {"--cells", "--own-axes"};
  if (wish.kind == cages::Kind::box) idle = {"--triangles", "--gap", "--symmetry", "--quads"};
  for (const std::string& name : idle) {
    if (command.get_option(name)->count() == 0) continue;
    throw CLI::ValidationError(name,
                               "has no effect with --kind " + std::string(base::entry_of(wish.kind).word));
  }
}

int make_cage(const CageOptions& options) {
  FilesInUse read;
  read.add(options.model, document::the_model);
  check_output(options.output.file, Content::surface, read, options.output.force);
  const formats::ReadResult model = foreign::read(options.model);
  files::add_surface(read, options.model, model.original.get(), model.attributes.get(), document::the_model);
  check_output(options.output.file, Content::surface, read, options.output.force);
  print_notes(model.warnings);
  auto work = std::make_unique<TerminalProgress>("Making " + options.output.file.filename().string());
  base::WorkerPool pool;
  base::Stopwatch watch;
  cages::Made made;
  try {
    if (model.splats) {
      const auto [core, note] = cages::core_of(mesh::lent(model.surface), *model.splats);
      made = cages::make(*core, options.wish, pool, &work->progress());
      if (!note.empty()) made.notes.push_back(note);
    } else {
      made = cages::make(model.surface, options.wish, pool, &work->progress());
    }
  } catch (const base::Error& error) {
    throw base::Error(options.model.string(), error.problem(), error.advice());
  }
  work.reset();  // removes the progress line
  const double seconds = 1e-3 * watch.lap_ms();
  const formats::Format& format = formats::surface_format(options.output.file);
  if (format.holds_morphs) check_rounded(options.output.file, made.surface, model.surface, pool);
  print_notes(made.notes);
  formats::write(options.output.file, made.surface, {"cage of " + options.model.filename().string()});
  print(made, format.keeps_order, seconds);
  return exit_ok;
}

}  // namespace

void add_cage_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("cage", "Make a cage around a mesh");
  auto o = std::make_shared<CageOptions>();
  cages::Wish& wish = o->wish;
  command->add_option("MODEL", o->model, foreign::a_mesh())->required();
  add_file_option(*command, "-o,--output", o->output.file,
                  "Mesh file to write; the extension sets the format")
      ->required();
  add_force_option(*command, o->output.force);
  add_choice<cages::Kind>(*command, "--kind", "Kind: automatic or box", wish.kind)->default_str("automatic");
  auto* triangles = command->add_option("--triangles", wish.triangles, "Number of triangles");
  whole_in_range(triangles, cages::least_triangles, cages::most_triangles)->default_str("200");
  const auto add_percent = [&](const std::string& name, const std::string& text, double& share, double low,
                               double high) {
    auto* option = command->add_option_function<double>(
        name, [&share](double percent) { share = 0.01 * percent; }, text);
    return in_range(option, 100 * low, 100 * high);
  };
  add_percent("--margin", "Distance to the mesh in % of its diagonal", wish.margin, cages::least_margin,
              cages::most_margin)
      ->default_str("0.15");
  add_percent("--gap", "Close gaps narrower than twice this distance, in % of the diagonal", wish.gap, 0,
              cages::most_gap)
      ->default_str("0.5");
  add_choice<cages::Symmetry>(*command, "--symmetry", "Plane of symmetry: auto, none, x, y or z",
                              wish.symmetry)
      ->default_str("auto");
  command->add_flag("--quads", wish.quads, "Pair triangles that form good quads");
  command
      ->add_option_function<std::string>(
          "--cells", [](const std::string&) {}, "Box: cells along each axis, up to 32 (default: 1x1x1)")
      ->option_text("NxMxK")
      ->check([&wish](const std::string& text) { return take_cells(text, wish.cells); });
  command->add_flag("--own-axes", wish.own_axes, "Box: align to the mesh's principal axes");
  add_examples(*command,
               {"cage model.obj -o cage.obj", "cage model.obj --triangles 500 --quads -o cage.obj"});
  command->callback([o, command, &action] {
    refuse_unused_options(*command, o->wish);
    action = [o] { return run_cancellable(o->output, [&] { return make_cage(*o); }); };
  });
}

}  // namespace viete::app
