#include "ui/stages.h"

#include <array>

#include "ui/overlay_painter.h"

namespace viete::ui {

const char* stage_hint(scene::Link stage) {
  static constexpr std::array<const char*, scene::link_count> hints = {
      "Affine map x -> M x + l of each element of the cage, from rest to pose.",
      "Polar decomposition M = R S of each map, and the logarithms Y = log R and X = log S.",
      "Weighted sums of the logarithms at each vertex.",
      "Exponentials of symmetric 3x3 matrices, one per vertex, by the chosen method.",
      "Stretch, rotation and translation of each vertex.",
      "Weighted sums at a few pivots of each block of vertices, from compressed weights.",
      "Sums, exponential and application in one pass over the vertices, in single precision.",
      "Rotation and stretch of each triangle of the model, fitted to the blended vertices.",
      "Sparse linear system for the positions whose triangles follow these maps best.",
      "Probes, applied after the cage.",
      "Vertex normals, from the triangles around each vertex."};
  return hints[static_cast<std::size_t>(stage)];
}

ImU32 lit_stage_color(const Context& ui, scene::Link stage) {
  const auto& lit = ui.workspace.interaction.stage;
  return faded(stage_color(stage), lit && *lit != stage ? 0.3f : 1.0f);
}

}  // namespace viete::ui
