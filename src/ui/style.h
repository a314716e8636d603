// Fonts and colours of the panels.
#pragma once

#include "ui/context.h"

namespace viete::ui {

/// Adds the fonts to ImGui's atlas, rasterized for `scale` device pixels per logical pixel. With
/// builtin_only, or if no font file is found, uses ImGui's bitmap font, which is identical on all machines
/// for tests.
Fonts add_fonts(float scale, bool builtin_only);

/// Sizes, spacing and colours; call when the theme changes.
void apply_style(bool dark);

}  // namespace viete::ui
