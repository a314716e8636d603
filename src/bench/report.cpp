// viete report [MODEL CAGE [POSE...]] -o FOLDER: measures all figures and writes them as one page.
#include "bench/options.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "app/assets.h"
#include "app/inputs.h"
#include "base/atomic_file.h"
#include "base/clock.h"
#include "base/error.h"
#include "bench/page.h"
#include "foreign/read.h"

namespace viete::bench {

namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  ReportFiles files;
  fs::path folder;
  bool quick = false, force = false;

  fs::path page() const { return folder / "index.html"; }
  fs::path numbers() const { return folder / "report.json"; }
};

// Creates the output folder. Returns false if it existed before.
bool made_folder(const fs::path& folder) {
  std::error_code code;
  if (fs::is_directory(folder, code)) return false;
  if (fs::exists(folder, code))
    throw base::Error(folder.string(), "this is not a folder", "choose another folder");
  if (fs::create_directory(folder, code)) return true;
  throw base::Error(folder.string(), "the folder cannot be created: " + code.message(),
                    "choose another folder");
}

// If no model is given, uses the bundled dragon. The shapes are always the dragon's shapes.
void complete(ReportFiles& files) {
  const app::BundledModel bundled = app::bundled_model();
  if (files.model.empty()) {
    files.model = bundled.model;
    files.cage = bundled.cage;
    files.poses = bundled.poses;
  }
  files.rest = bundled.model;
  for (const char* shape : {"folded", "coiled", "sitting"})
    files.shapes.push_back(bundled.model.parent_path() / ("shape_" + std::string(shape) + ".pc2"));
}

void check_outputs(const ReportOptions& options) {
  app::FilesInUse inputs{options.files.model, options.files.cage};
  for (const auto& pose : options.files.poses) inputs.add(pose, document::the_pose);
  app::check_output(options.page(), app::Content::page, inputs, options.force);
  app::check_output(options.numbers(), app::Content::json, inputs, options.force);
}

std::string typed(const ReportOptions& options, const ReportFiles& named) {
  std::string command = "viete report";
  for (const fs::path& file : {named.model, named.cage})
    if (!file.empty()) command += " " + shell_word(file);
  for (const fs::path& pose : named.poses) command += " " + shell_word(pose);
  return command + " -o " + shell_word(options.folder) + (options.quick ? " --quick" : "");
}

void write(const ReportOptions& options, const Figures& figures, const Made& made) {
  base::FilesTogether files;
  const auto put = [&](const fs::path& file, const std::string& text) {
    files.put(file, [&](const base::ByteSink& sink) { sink(text); });
  };
  put(options.page(), report_page(figures, made));
  put(options.numbers(), report_json(figures, made).dump(1) + '\n');
  files.replace();
}

Figures measured(const ReportOptions& options, const ReportSizes& sizes) try {
  app::TerminalProgress work("Measuring");
  return measure_figures(options.files, sizes, work.progress());
} catch (const base::Cancelled&) {
  throw base::Error(options.folder.string(), "the measurement was stopped", "no file was changed");
}

void make_report(ReportOptions options) {
  const std::string command = typed(options, options.files);
  check_outputs(options);
  complete(options.files);
  const ReportSizes sizes = options.quick ? quick_sizes() : ReportSizes();
  base::require_memory(
      {160.0 * static_cast<double>(sizes.matrices), "a report takes", "add --quick", "--output"});
  const double begun = base::wall_seconds();
  const Figures figures = measured(options, sizes);
  write(options, figures, made_here(command, base::wall_seconds() - begun));
}

int run_report(const ReportOptions& options) {
  const bool is_new = made_folder(options.folder);
  try {
    make_report(options);
  } catch (...) {
    std::error_code not_empty;
    if (is_new) fs::remove(options.folder, not_empty);
    throw;
  }
  std::printf("Saved %s and its numbers, report.json.\n", options.page().string().c_str());
  return app::exit_ok;
}

}  // namespace

void add_report_command(CLI::App& app, app::Action& action) {
  auto* command = app.add_subcommand("report", app::report_text);
  auto options = std::make_shared<ReportOptions>();
  auto& files = options->files;
  app::add_file_option(*command, "MODEL", files.model, foreign::a_mesh())->default_str("the bundled dragon");
  app::add_file_option(*command, "CAGE", files.cage, "Cage at rest")->default_str("the dragon's cage");
  command->add_option("POSE", files.poses, "Posed cages (same vertices, same order)")
      ->default_str("the dragon's poses, or one generated pose");
  app::add_file_option(*command, "-o,--output", options->folder, "Folder for index.html and report.json")
      ->option_text("FOLDER")
      ->required();
  command->add_flag("--quick", options->quick, "Use fewer matrices, cages and rounds; takes half a minute");
  app::add_force_option(*command, options->force);
  app::add_examples(*command, {"report -o report --quick", "report model.obj cage.obj pose.obj -o report"});
  command->callback([options, &action] {
    if (!options->files.model.empty() && options->files.cage.empty()) throw CLI::RequiredError("CAGE");
    action = [options] { return run_report(*options); };
  });
}

}  // namespace viete::bench
