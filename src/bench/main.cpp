// viete-bench: runs `viete bench` and `viete report`.
#include <string>
#include <vector>

#include "bench/options.h"

namespace {

void add_commands(CLI::App& app, viete::app::Action& action) {
  viete::bench::add_bench_command(app, action);
  viete::bench::add_report_command(app, action);
}

// Allows a benchmark name without `bench` before it.
std::vector<std::string> with_command(std::vector<std::string> typed, const CLI::App&) {
  if (typed.empty() || typed.front() != "report") typed.insert(typed.begin(), "bench");
  return typed;
}

}  // namespace

int main(int argc, char** argv) {
  return viete::app::run_program(argc, argv, {add_commands, with_command});
}
