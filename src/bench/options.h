// The command lines of `viete bench` and `viete report`.
#pragma once

#include "app/command_line.h"

namespace viete::bench {

void add_bench_command(CLI::App& app, app::Action& action);
void add_report_command(CLI::App& app, app::Action& action);

}  // namespace viete::bench
