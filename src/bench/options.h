// `viete bench` and its command line.
#pragma once

#include "app/command_line.h"

namespace viete::bench {

void add_bench_command(CLI::App& app, app::Action& action);

}  // namespace viete::bench
