// The stages of a deformation, as timings and formula show them.
#pragma once

#include <optional>
#include <string>

#include "ui/context.h"

namespace viete::ui {

/// Describes the stage in one sentence.
const char* stage_hint(scene::Link stage);
/// Its colour; fainter while the cursor is on another stage.
ImU32 lit_stage_color(const Context& ui, scene::Link stage);

/// The formula by which the running frame makes positions, each term in the colour of the stage that computes
/// it. The stage of the term under the cursor, if there is one.
std::optional<scene::Link> frame_formula(const Context& ui);

}  // namespace viete::ui
