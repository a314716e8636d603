#include "app/cage_marks.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "scene/document/elements.h"

namespace viete::app {

namespace {

using scene::ElementKind;

void set_triangles(render::FaceLayer& layer, const std::vector<render::Triangle>& triangles,
                   const std::vector<mesh::Point>& positions) {
  layer.set_triangles(triangles, positions.size());
  if (!triangles.empty()) layer.set_positions(positions);
}

std::vector<std::uint8_t> marks_of(const deform::Cage& cage, const scene::Selection& selection) {
  std::vector<std::uint8_t> marked(scene::element_count(cage, selection.kind()), 0);
  for (const auto i : selection.indices()) marked[i] = 1;
  return marked;
}

}  // namespace

bool CageMarks::set(const scene::Workspace& workspace, const render::Theme& theme) {
  Marks marks;
  marks.positions = workspace.document.pose.positions;
  if (workspace.tools) add_faces(workspace, marks), add_edges(workspace, theme, marks);
  if (marks == marks_) return false;
  marks_ = std::move(marks);
  upload();
  return true;
}

void CageMarks::upload() {
  const auto& [selected, hovered, edges, colors, positions] = *marks_;
  set_triangles(selected_faces_, selected, positions);
  set_triangles(hovered_face_, hovered, positions);
  edges_.set_segments(edges, positions.size());
  edges_.set_colors(colors);
  if (!edges.empty()) edges_.set_positions(positions);
}

void CageMarks::add_faces(const scene::Workspace& workspace, Marks& marks) {
  const auto& document = workspace.document;
  const auto& surface = document.cage->surface;
  if (document.selection.kind() != ElementKind::face) return;
  const auto marked = marks_of(*document.cage, document.selection);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto face = surface.triangle_polygon[t];
    if (marked[face]) marks.selected.push_back(surface.triangles[t]);
    if (workspace.interaction.hovered == face) marks.hovered.push_back(surface.triangles[t]);
  }
}

// Edges of selected faces count as selected; the hovered element's come last, over them.
void CageMarks::add_edges(const scene::Workspace& workspace, const render::Theme& theme, Marks& marks) {
  const auto& document = workspace.document;
  const auto kind = document.selection.kind();
  auto& segments = marks.edges;
  const auto add = [&](std::uint32_t element) {
    const auto corners = scene::element_vertices(*document.cage, kind, element);
    const std::size_t sides = corners.size() > 2 ? corners.size() : corners.size() - 1;
    for (std::size_t i = 0; i < sides; ++i)
      segments.push_back({corners[i], corners[(i + 1) % corners.size()]});
  };
  if (kind != ElementKind::probe) {
    for (const auto i : document.selection.indices()) add(i);
  }
  const std::size_t selected = segments.size();
  const auto hovered = workspace.interaction.hovered;
  if (hovered && *hovered < scene::element_count(*document.cage, kind)) add(*hovered);
  marks.colors.assign(segments.size(), glm::vec4(theme.hover, 0.85f));
  std::fill_n(marks.colors.begin(), selected, glm::vec4(theme.selection, 1));
}

void CageMarks::draw(const render::View& view, const render::Theme& theme) const {
  selected_faces_.draw(view, {theme.selection, 0.22f, 0.05f, false});
  hovered_face_.draw(view, {theme.hover, 0.10f, 0.05f, false});
  edges_.draw(view, {2.25f, 1, 0.4f, theme.halo});
}

}  // namespace viete::app
