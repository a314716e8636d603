// Fonts and colours of the panels.
#pragma once

#include "ui/context.h"

namespace viete::ui {

/// Adds the fonts to ImGui's atlas, rasterised for `scale` device pixels per logical pixel. With
/// builtin_only, or where no font file is found, ImGui's own bitmap font is used: pictures in tests are then
/// the same everywhere.
Fonts add_fonts(float scale, bool builtin_only);

/// Sizes, spacing and colours; call when the theme changes.
void apply_style(bool dark);

}  // namespace viete::ui
