// Highlights on model and cage: selected and hovered elements of the cage, and findings of the checks.
#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "app/workspace_renderer.h"
#include "scene/document/elements.h"

namespace viete::app {

namespace {

using scene::ElementKind;

void set_triangles(render::FaceLayer& layer, const std::vector<render::Triangle>& triangles,
                   const std::vector<mesh::Point>& positions) {
  layer.set_triangles(triangles, positions.size());
  if (!triangles.empty()) layer.set_positions(positions);
}

// The edges of an element: a closed polygon, one edge, or none for a vertex.
void add_outline(const std::vector<std::uint32_t>& corners, std::vector<render::Segment>& segments) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < (n > 2 ? n : n - 1); ++i)
    segments.push_back({corners[i], corners[(i + 1) % n]});
}

std::vector<std::uint8_t> marks_of(const deform::Cage& cage, const scene::Selection& selection) {
  std::vector<std::uint8_t> marked(scene::element_count(cage, selection.kind()), 0);
  for (const auto i : selection.indices()) marked[i] = 1;
  return marked;
}

}  // namespace

bool CageMarks::set(const scene::Workspace& w, const render::Theme& theme) {
  Marks marks;
  marks.positions = w.document.pose.positions;
  if (w.tools) add_faces(w, marks), add_edges(w, theme, marks);
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

void CageMarks::add_faces(const scene::Workspace& w, Marks& marks) {
  const auto& document = w.document;
  const auto& surface = document.cage->surface;
  if (document.selection.kind() != ElementKind::face) return;
  const auto marked = marks_of(*document.cage, document.selection);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto face = surface.triangle_polygon[t];
    if (marked[face]) marks.selected.push_back(surface.triangles[t]);
    if (w.interaction.hovered == face) marks.hovered.push_back(surface.triangles[t]);
  }
}

// Edges of selected faces count as selected; hovered edges are drawn last, on top.
void CageMarks::add_edges(const scene::Workspace& w, const render::Theme& theme, Marks& marks) {
  const auto& document = w.document;
  const auto kind = document.selection.kind();
  auto& segments = marks.edges;
  const auto add = [&](std::uint32_t element) {
    add_outline(scene::element_vertices(*document.cage, kind, element), segments);
  };
  if (kind != ElementKind::probe) {
    for (const auto i : document.selection.indices()) add(i);
  }
  const std::size_t selected = segments.size();
  const auto hovered = w.interaction.hovered;
  if (hovered && *hovered < scene::element_count(*document.cage, kind)) add(*hovered);
  marks.colors.assign(segments.size(), glm::vec4(theme.hover, 0.85f));
  std::fill_n(marks.colors.begin(), selected, glm::vec4(theme.selection, 1));
}

void CageMarks::draw(const render::View& view, const render::Theme& theme) const {
  selected_faces_.draw(view, {theme.selection, 0.22f, 0.05f, false});
  hovered_face_.draw(view, {theme.hover, 0.10f, 0.05f, false});
  edges_.draw(view, {2.25f, 1, 0.4f, theme.halo});
}

namespace {

constexpr std::size_t most = 20000;  // elements drawn; more would cover the surface

}  // namespace

void FindingMarks::collect(const scene::Workspace& w) {
  std::vector<render::Triangle> triangles;
  std::vector<render::Segment> segments;
  // Renumbers the vertices of a few elements, so that only those are drawn and updated.
  used_.clear();
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  const auto number = [&](std::uint32_t vertex) {
    const auto [at, added] = numbers.try_emplace(vertex, static_cast<std::uint32_t>(used_.size()));
    if (added) used_.push_back(vertex);
    return at->second;
  };
  bool vertices = false;
  if (w.checks.shown) {
    const scene::Finding& finding = w.checks.findings[*w.checks.shown];
    const bool of_cage = finding.subject == scene::Subject::cage;
    const mesh::Surface& surface = of_cage ? *w.document.cage_file.surface : *w.document.model.surface;
    vertices = finding.kind == scene::ElementKind::vertex;
    for (const auto e : scene::shown_elements(w.checks, most)) {
      auto corners = scene::vertices_of(finding, surface, e);
      for (auto& v : corners) v = number(v);
      const std::size_t n = corners.size();
      for (std::size_t i = 2; i < n; ++i) triangles.push_back({corners[0], corners[i - 1], corners[i]});
      add_outline(corners, segments);
    }
  }
  faces_.set_triangles(triangles, used_.size());
  edges_.set_segments(segments, used_.size());
  const glm::vec4 color(render::theme(w.view.dark).finding, 1);
  edges_.set_color(color);
  vertices_.set_discs(std::vector<render::Disc>(used_.size(), {color, vertices ? 4.0F : 2.5F, false}));
}

bool FindingMarks::set(const scene::Workspace& w, const scene::PosedModel& posed, bool moved) {
  const bool same = revision_ == w.checks.revision() && dark_ == w.view.dark;
  if (same && (!moved || used_.empty())) return false;
  if (!same) collect(w);
  revision_ = w.checks.revision();
  dark_ = w.view.dark;
  if (used_.empty()) {
    vertices_.set_positions({});
    return true;
  }
  const bool of_cage = w.checks.findings[*w.checks.shown].subject == scene::Subject::cage;
  std::vector<mesh::Point> positions;
  positions.reserve(used_.size());
  for (const auto v : used_)
    positions.push_back(of_cage ? w.document.pose.positions[v] : posed.at(*w.document.model.surface, v));
  faces_.set_positions(positions);
  edges_.set_positions(positions);
  vertices_.set_positions(positions);
  return true;
}

void FindingMarks::draw(const render::View& view, const render::Theme& theme) const {
  if (used_.empty()) return;
  faces_.draw(view, {theme.finding, 0.30F, 0.05F, false});
  edges_.draw(view, {2.5F, 1, 0.7F});
  vertices_.draw(view, {theme.outline, theme.hover, 0.7F});
}

}  // namespace viete::app
