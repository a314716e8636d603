// The program `viete`: its commands, and the small command `manual [CHAPTER]`, which opens the manual in the
// browser.
#include "app/command_line.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/assets.h"
#include "app/options.h"
#include "base/error.h"
#include "base/os.h"

namespace viete::app {

namespace {

bool is_command(const std::string& word, const CLI::App& app) {
  const auto names = command_names(app);
  return std::find(names.begin(), names.end(), word) != names.end();
}

// Throws CLI::ParseError if no file has the name `word`, and `word` contains neither '.' nor '/'.
void check_first_word(const std::string& word, const CLI::App& app) {
  std::error_code ignored;
  if (word.find_first_of("./") != word.npos || std::filesystem::exists(word, ignored)) return;
  const std::string meant = nearest(word, command_names(app));
  throw CLI::ParseError(
      word + ": no such command or file" + (meant.empty() ? "" : "; did you mean viete " + meant + "?"),
      exit_usage);
}

// The first build skips viete-bench. Builds it if `folder` is a build folder; shows the output on stderr.
void build_bench(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "CMakeCache.txt")) return;
  std::fputs("viete: building the benchmarks before their first use\n", stderr);
  base::os::run_and_wait({"cmake", "--build", folder.string(), "--target", "viete-bench"});
}

// Replaces this process by the program viete-bench in the folder of viete.
[[noreturn]] void exec_bench(std::vector<std::string> arguments) {
  const std::filesystem::path program = program_folder() / base::os::program_name("viete-bench");
  if (!std::filesystem::exists(program)) build_bench(program_folder());
  arguments.insert(arguments.begin(), program.string());
  throw base::Error(program.string(), base::os::replace_process(arguments),
                    "build the benchmarks and run them with third_party/setup.sh bench");
}

// Without a command, inserts `view`. Replaces `viete help render` by `viete render --help`.
std::vector<std::string> with_command(std::vector<std::string> words, const CLI::App& app) {
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    if (!words.empty() && words.front() == "deformers") throw CLI::CallForVersion(deformers_help(), exit_ok);
    if (!words.empty() && !is_command(words.front(), app)) check_first_word(words.front(), app);
    words.emplace_back("--help");
  }
  const std::string first = words.empty() ? "" : words.front();
  if (first == "bench") exec_bench({words.begin() + 1, words.end()});
  if (first == "report") exec_bench(words);
  if (first == "-h" || first == "--help" || first == "--version" || is_command(first, app)) return words;
  if (!first.empty() && first[0] != '-') check_first_word(first, app);
  words.insert(words.begin(), "view");
  return words;
}

void add_commands(CLI::App& app, Action& action) {
  add_view_command(app, action);
  add_render_command(app, action);
  add_deform_command(app, action);
  add_animate_command(app, action);
  add_between_command(app, action);
  add_mix_command(app, action);
  add_pose_command(app, action);
  add_cage_command(app, action);
  add_info_command(app, action);
  add_manual_command(app, action);
  app.add_subcommand("bench", bench_text);
  app.add_subcommand("report", report_text);
}

int show_manual(const std::string& chapter) {
  const std::filesystem::path page = manual_page(chapter);
  std::printf("%s\n", page.string().c_str());
  if (base::os::has_display()) base::os::open_page(page);
  return exit_ok;
}

}  // namespace

Program viete_program() {
  return {add_commands, with_command};
}

void add_manual_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("manual", "Open the manual in the browser");
  auto chapter = std::make_shared<std::string>();
  command->add_option("CHAPTER", *chapter, "Chapter, for example cages, blending or python")
      ->default_str("the first page");
  add_examples(*command, {"manual", "manual cages"});
  command->callback([chapter, &action] { action = [chapter] { return show_manual(*chapter); }; });
}

}  // namespace viete::app
