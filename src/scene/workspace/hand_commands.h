// Commands that say how the hand moves: pivot, axes, mirror, soft selection.
#pragma once

#include <string>

#include "scene/document/handling.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// "pivot_median", "axes_view", "mirror_x", "soft_smooth", "soft_edges": of the command that chooses it.
std::string choice_command_name(Pivot);
std::string choice_command_name(Axes);
std::string choice_command_name(MirrorPlane);
std::string choice_command_name(SoftCurve);
std::string choice_command_name(SoftDistance);

}  // namespace viete::scene
