// viete bench bind: what binding costs, against plain loops, in time and memory.
#pragma once

#include "app/command_line.h"

namespace viete::app {

void add_bind_bench(CLI::App& bench, Action& action);

}  // namespace viete::app
