// What the deformer had to decide in a pose, in words.
#pragma once

#include <string>
#include <vector>

#include "deform/log_maps.h"

namespace viete::scene {

/// One line per kind of trouble, with how often and the first place; nothing for a pose without trouble. A
/// closed cage that is turned inside out, as by a mirror, is told from one that is only torn.
std::vector<std::string> pose_notes(const deform::LogReport& report, const deform::Cage& cage,
                                    const deform::Pose& pose);

}  // namespace viete::scene
