// The stages of a deformation, for the timings.
#pragma once

#include <optional>
#include <string>

#include "ui/context.h"

namespace viete::ui {

/// Describes the stage in one sentence.
const char* stage_hint(scene::Link stage);
/// Its colour; fainter while another stage is hovered.
ImU32 lit_stage_color(const Context& ui, scene::Link stage);

}  // namespace viete::ui
