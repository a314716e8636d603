// viete-bench: what `viete bench` becomes.
#include <string>
#include <vector>

#include "app/program.h"
#include "bench/command.h"

int main(int argc, char** argv) {
  const auto words = [](std::vector<std::string> typed, const CLI::App&) {
    typed.insert(typed.begin(), "bench");
    return typed;
  };
  return viete::app::run_program(argc, argv, {viete::bench::add_bench_command, words});
}
