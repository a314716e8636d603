// The parts of a frame, as timings and formula show them: the links, and what comes after them.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "ui/context.h"

namespace viete::ui {

inline constexpr std::size_t part_count = scene::link_count + 4;
using Parts = std::array<double, part_count>;

Parts parts_of(const scene::FrameTimes& frame);
std::string part_name(std::size_t part);
/// What it does, in one sentence or two, in the words of the field.
const char* part_hint(std::size_t part);
/// Its colour; fainter while the cursor is on another part.
ImU32 lit_part_color(const Context& ui, std::size_t part);

/// The formula by which the running frame makes positions, each term in the colour of the part that computes
/// it. The part of the term under the cursor, if there is one.
std::optional<std::size_t> frame_formula(const Context& ui);

}  // namespace viete::ui
