// A few seconds of the dragon: keys of its cage, as a session of the program.
#pragma once

#include <string>

#include "dragon/cage.h"

namespace viete::dragon {

/// The text of a session that names dragon.ply and cage.obj beside it. It holds the poses by name, and a loop
/// of five seconds: from the alert pose over two wing beats, between which the head sweeps from over the left
/// wing to over the right one, 195 degrees in one go, and back.
std::string loop_session(const Cage& cage);

}  // namespace viete::dragon
