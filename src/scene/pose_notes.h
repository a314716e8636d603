// What the deformer had to decide in a pose, in words.
#pragma once

#include <string>
#include <vector>

#include "deform/log_maps.h"

namespace viete::scene {

/// One line per kind of trouble, with how often and the first place; nothing for a pose without trouble.
std::vector<std::string> pose_notes(const deform::LogReport& report);

}  // namespace viete::scene
