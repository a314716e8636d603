// The stages of a deformation, for the timings and the formula.
#pragma once

#include <optional>
#include <string>

#include "ui/context.h"

namespace viete::ui {

/// Describes the stage in one sentence.
const char* stage_hint(scene::Link stage);
/// Its colour; fainter while another stage is hovered.
ImU32 lit_stage_color(const Context& ui, scene::Link stage);

/// Draws the formula of the running frame, each term in the colour of its stage. Returns the stage of the
/// hovered term, if any.
std::optional<scene::Link> frame_formula(const Context& ui);

}  // namespace viete::ui
