// viete: the program's front door.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "app/build_facts.h"
#include "app/command_line.h"
#include "sym3/kernel.h"

namespace {

using namespace viete;
using namespace viete::app;

constexpr const char* footer =
    "Exit codes: 0 done; 1 a file could not be read or written, or the work failed (the reason is on "
    "stderr); 2 wrong "
    "command line.";

std::string usage_error(const CLI::App* app, const CLI::Error& error) {
  return "viete: " + std::string(error.what()) + "\nRun " + app->get_name() + " --help for more.\n";
}

// `viete`, `viete MODEL CAGE` and `viete --pose P MODEL CAGE` mean `viete view ...`.
std::vector<std::string> with_default_command(int argc, char** argv, const CLI::App& app) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const std::string first = words.empty() ? "" : words.front();
  const bool global = first == "-h" || first == "--help" || first == "--version";
  if (!global && app.get_subcommands([&](const CLI::App* s) { return s->get_name() == first; }).empty())
    words.insert(words.begin(), "view");
  return words;
}

int run(int argc, char** argv) {
  CLI::App app("Viete: deform a mesh by its cage, through the exponential of symmetric 3x3 matrices",
               "viete");
  app.set_version_flag("--version", std::string("viete ") + version() + "\n" + build_type() + ", kernel " +
                                        std::string(sym3::kernel_name()));
  app.footer(footer);
  app.failure_message(usage_error);
  app.require_subcommand(1);
  Action action;
  add_view_command(app, action);
  add_render_command(app, action);
  add_deform_command(app, action);
  add_bind_command(app, action);
  add_info_command(app, action);
  add_bench_command(app, action);
  try {
    std::vector<std::string> words = with_default_command(argc, argv, app);
    std::reverse(words.begin(), words.end());  // CLI11 takes its arguments from the back
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_usage;
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
  } catch (const std::exception& error) {
    std::fprintf(stderr, "viete: %s\n", error.what());
    return exit_failed;
  }
}
