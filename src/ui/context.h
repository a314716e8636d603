// What every panel gets: the workspace, the fonts, the theme, and a recorder when tests are watching.
#pragma once

#include <imgui.h>

#include <vector>

#include "scene/workspace/workspace.h"
#include "ui/recorder.h"

namespace viete::ui {

/// null fonts mean the default font.
struct Fonts {
  ImFont* text = nullptr;
  ImFont* strong = nullptr;
  ImFont* numbers = nullptr;  ///< tabular figures
};

/// Colours that ImGui's style has no place for.
struct Palette {
  ImU32 text, faint, accent, good, warn, bad, card, card_hover, card_active, line;
  ImU32 model;             ///< in small pictures
  ImU32 axis[3], on_axis;  ///< of x, y and z, and of letters on them
  ImU32 neutral, highlight,
      halo;  ///< of a gizmo: handles without an axis, the one under the cursor, the edge around lines
};

Palette palette(bool dark);

/// Of maps, from the low end to the high one.
struct FieldColors {
  std::vector<ImU32> even, diverging;
};

struct Context {
  scene::Workspace& workspace;
  const Fonts& fonts;
  Palette colors;
  Recorder* recorder;  ///< null when nobody is watching
  const FieldColors& field_colors;
};

inline constexpr float status_height = scene::PanelLayout::status_height;

/// The colour of a stage of the deformation, the same everywhere.
ImU32 stage_color(scene::Link stage);

}  // namespace viete::ui
