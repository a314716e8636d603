#include "ui/frame_parts.h"

#include <algorithm>

#include "ui/overlay_painter.h"

namespace viete::ui {

Parts parts_of(const scene::FrameTimes& frame) {
  Parts parts{};
  std::copy(frame.links.ms.begin(), frame.links.ms.end(), parts.begin());
  parts[scene::link_count] = frame.upload;
  parts[scene::link_count + 1] = frame.draw;
  parts[scene::link_count + 2] = frame.panels;
  parts[scene::link_count + 3] = std::max(0.0, frame.other());
  return parts;
}

std::string part_name(std::size_t part) {
  static constexpr const char* others[] = {"upload", "draw", "panels", "other"};
  if (part >= scene::link_count) return others[part - scene::link_count];
  return std::string(name(static_cast<scene::Link>(part)));
}

const char* part_hint(std::size_t part) {
  static constexpr std::array<const char*, part_count> hints = {
      "The affine map x -> M x + l of each element of the cage, from rest to pose.",
      "Polar decomposition M = R S of each map, and the logarithms Y = log R and X = log S; branches of the "
      "rotations are chosen along a spanning forest of the cage's faces.",
      "Weighted sums of the logarithms: the matrix of weights, vertices by elements, times the rows of the "
      "cage.",
      "Exponentials of symmetric 3x3 matrices, one a vertex, by the chosen method.",
      "Stretch, rotation and translation of each vertex.",
      "Low-rank factors of the weight matrix: sums are formed at a few pivots of each leaf of vertices and "
      "interpolated to the others.",
      "Kernel fusion: sums, exponential and application in one pass over the vertices, in float.",
      "A rotation and stretch of each triangle of the model, fitted to where it was blended.",
      "Positions whose triangles follow those maps best: a sparse linear system, factored (Cholesky) when "
      "the model was bound.",
      "The layer of probes, upon what the cage does.",
      "Vertex normals, from the triangles of each one-ring.",
      "Vertices copied to the graphics card.",
      "The view is drawn; a software rasteriser does that on the processor.",
      "Panels are laid out.",
      "What is left of the frame: input, commands, waiting for the graphics card."};
  return hints[part];
}

ImU32 lit_part_color(const Context& ui, std::size_t part) {
  const auto& lit = ui.workspace.interaction.part;
  return faded(part_color(part), lit && *lit != part ? 0.3f : 1.0f);
}

}  // namespace viete::ui
