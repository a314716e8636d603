// Fonts and colours of the panels.
#pragma once

#include "ui/context.h"

namespace viete::ui {

/// Adds the fonts to ImGui, for `scale` device pixels per logical pixel. With `builtin_only`, or if no font
/// file is found, uses ImGui's own bitmap font, which is the same on all machines.
Fonts add_fonts(float scale, bool builtin_only);

/// Sizes, spacing and colours; call when the theme changes.
void apply_style(bool dark);

}  // namespace viete::ui
