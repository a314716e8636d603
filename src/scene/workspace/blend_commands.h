// Commands that choose how maps are blended, and how the exponential is computed.
#pragma once

#include <string>

#include "deform/ways.h"

namespace viete::scene {

/// "way_paper", "elements_face", "weights_mean_value", "blend_srl": of the command that chooses it.
std::string choice_command_name(deform::Way way);
std::string choice_command_name(deform::Elements elements);
std::string choice_command_name(deform::Weights weights);
std::string choice_command_name(deform::Blend blend);

}  // namespace viete::scene
