// viete bench frame: what a frame costs, by path, size and stage.
#pragma once

#include "app/command_line.h"

namespace viete::app {

void add_frame_bench(CLI::App& bench, Action& action);

}  // namespace viete::app
