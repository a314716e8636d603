// Where the program keeps what it remembers between runs.
#pragma once

#include <filesystem>

namespace viete::app {

/// $XDG_STATE_HOME/viete, or ~/.local/state/viete where the variable is empty or no absolute path (as the XDG
/// base directory specification says). Empty if there is no home folder either: then nothing is remembered.
std::filesystem::path state_folder();

}  // namespace viete::app
