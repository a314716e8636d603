// viete: the program's front door.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "app/build_facts.h"
#include "app/command_line.h"
#include "app/help.h"
#include "app/words.h"
#include "sym3/kernel.h"

namespace {

using namespace viete;
using namespace viete::app;

constexpr const char* footer =
    "Exit codes: 0 done; 1 a file could not be read or written, or the work failed (the reason is on "
    "stderr); 2 wrong command line.";

bool is_command(const std::string& word, const CLI::App& app) {
  const auto names = command_names(app);
  return std::find(names.begin(), names.end(), word) != names.end();
}

// A word that is neither a command nor looks like a file, nor is one, was meant as a command.
void check_first_word(const std::string& word, const CLI::App& app) {
  std::error_code ignored;
  if (word.find_first_of("./") != word.npos || std::filesystem::exists(word, ignored)) return;
  const std::string meant = nearest(word, command_names(app));
  throw CLI::ParseError(word + ": there is neither a command nor a file of this name" +
                            (meant.empty() ? "" : "; did you mean viete " + meant + "?"),
                        exit_usage);
}

// `viete`, `viete MODEL CAGE` and `viete --pose P MODEL CAGE` mean `viete view ...`; `viete help render`
// means `viete render --help`.
std::vector<std::string> with_command(std::vector<std::string> words, const CLI::App& app) {
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    if (!words.empty() && !is_command(words.front(), app)) check_first_word(words.front(), app);
    words.emplace_back("--help");
  }
  const std::string first = words.empty() ? "" : words.front();
  if (first == "-h" || first == "--help" || first == "--version" || is_command(first, app)) return words;
  if (!first.empty() && first[0] != '-') check_first_word(first, app);
  words.insert(words.begin(), "view");
  return words;
}

// A value that is wrong is told before what is missing, in every version of CLI11.
void values_first([[maybe_unused]] CLI::App& app) {
#if CLI11_VERSION_MAJOR > 2 || CLI11_VERSION_MINOR >= 6
  app.option_defaults()->callback_priority(CLI::CallbackPriority::PreRequirementsCheck);
#endif
}

int run(int argc, char** argv) {
  CLI::App app("Viete: deform a mesh by its cage, through the exponential of symmetric 3x3 matrices",
               "viete");
  app.set_version_flag("--version",
                       std::string("viete ") + version() + "\n" + build_type() + ", kernel " +
                           std::string(sym3::kernel_name()),
                       "Say version, build, compiler and kernel, and exit");
  app.footer(footer);
  app.formatter(help_formatter());
  app.set_help_flag("-h,--help", "Say this and exit");
  app.require_subcommand(1);
  values_first(app);  // before the commands, which take it over
  Action action;
  add_view_command(app, action);
  add_render_command(app, action);
  add_deform_command(app, action);
  add_animate_command(app, action);
  add_cage_command(app, action);
  add_bind_command(app, action);
  add_info_command(app, action);
  add_bench_command(app, action);
  try {
    std::vector<std::string> words = with_command({argv + 1, argv + argc}, app);
    std::reverse(words.begin(), words.end());  // CLI11 takes its arguments from the back
    app.parse(words);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fputs(usage_error(app, error).c_str(), stderr);
    return exit_usage;
  }
  const int code = action();
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    std::fprintf(stderr, "viete: the output could not be written\n");
    return exit_failed;
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  const char* kernel = std::getenv("VIETE_KERNEL");
  if (kernel && viete::sym3::kernel_name() != kernel) {
    std::fprintf(stderr, "viete: note: VIETE_KERNEL=%s is no kernel of this machine; running %s\n", kernel,
                 std::string(viete::sym3::kernel_name()).c_str());
  }
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "viete: there is not enough memory; close other programs, or use a smaller model\n");
    return exit_failed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "viete: %s\n", error.what());
    return exit_failed;
  }
}
