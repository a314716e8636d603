#include "document/cage_editing.h"

#include <utility>

#include "base/error.h"
#include "cages/edit.h"
#include "cages/enclose.h"
#include "document/edit.h"
#include "document/elements.h"
#include "document/mirror.h"
#include "document/pose_edit.h"
#include "document/probes.h"
#include "mesh/triangulation.h"

namespace viete::document {

namespace {

constexpr double snug_margin = 0.2 * fit_margin;

std::string edited_name(const OpenedSurface& cage) {
  constexpr std::string_view mark = ", edited";
  const std::string name = name_of(cage);
  return name.ends_with(mark) ? name : name + std::string(mark);
}

// How an edit changes the displacements from rest to pose. Displacements of mirrored vertices are mirrored at
// `plane`. All displacements are multiplied by `scale`.
struct Follow {
  cages::Plane plane{};
  double scale = 1;
};

// Transfers a pose to the edited cage. If the number of parts is unchanged, keeps the parts' whole turns.
pose::Pose carried(const pose::Cage& before, const pose::Pose& pose, const cages::Edited& edited,
                   const pose::Cage& after, const Follow& follow) {
  pose::Pose now;
  if (before.roots.size() == after.roots.size()) now.turns = pose.turns;
  for (std::size_t v = 0; v < edited.origins.size(); ++v) {
    const cages::Origin& origin = edited.origins[v];
    mesh::Vec3 offset{0, 0, 0};
    const double share = 1 / static_cast<double>(origin.of.size());
    for (const auto o : origin.of)
      offset = offset + share * (pose.positions[o] - before.surface.positions[o]);
    if (origin.mirrored) offset = reflected_direction(follow.plane, offset);
    now.positions.push_back(edited.surface.positions[v] + follow.scale * offset);
  }
  return now;
}

// Replaces the cage. During cage editing, shows the new cage at rest. Otherwise transfers the pose to the new
// cage. If `label` is empty, the change becomes part of the last edit.
void put_edited(Document& document, cages::Edited edited, const std::string& label,
                const Follow& follow = {}) {
  auto cage = std::make_shared<const pose::Cage>(pose::make_cage(edited.surface));
  pose::Pose real = carried(*document.cage(), real_pose(document), edited, *cage, follow);
  label.empty() ? document.changed_history().extend_last() : record_edit(document, label);
  carry_poses(document,
              [&](const pose::Pose& pose) { return carried(*document.cage(), pose, edited, *cage, follow); });
  const bool editing = is_editing_cage(document);
  std::vector<std::span<const std::uint32_t>> origins;
  for (const cages::Origin& origin : edited.origins) origins.emplace_back(origin.of);
  CageGroups groups = carried(document.groups(), document.cage()->surface.positions.size(), origins);
  const ElementKind kind = document.selection().kind();
  OpenedSurface file = generated_surface(std::move(edited.surface), edited_name(document.cage_file()));
  if (editing) document.changed_source().kept = real;
  document.replace_cage(std::move(file), cage, editing ? pose::rest_pose(*cage) : std::move(real));
  document.changed_groups() = std::move(groups);
  if (kind == ElementKind::probe) return;
  const Selection made(ElementKind::vertex, edited.selection);
  document.changed_selection() = without_hidden(document, converted(*document.cage(), made, kind));
}

cages::Edited with_positions(const mesh::Surface& cage, std::vector<mesh::Point> positions) {
  cages::Edited edited{cage, {}, {}};
  edited.surface.positions = std::move(positions);
  mesh::triangulate(edited.surface);
  for (std::uint32_t v = 0; v < cage.positions.size(); ++v) edited.origins.push_back({{v}});
  return edited;
}

std::vector<mesh::Edge> selected_edges(const Document& document) {
  const Selection edges = converted(*document.cage(), document.selection(), ElementKind::edge);
  std::vector<mesh::Edge> all;
  for (const auto e : edges.indices()) all.push_back(document.cage()->edges[e]);
  return all;
}

std::vector<std::uint32_t> selected_polygons(const Document& document) {
  return converted(*document.cage(), document.selection(), ElementKind::face).indices();
}

void require(bool any, const char* what, const char* advice) {
  if (!any) throw base::Error("", what, advice);
}

}  // namespace

void begin_cage_editing(Document& document) {
  record_edit(document, "edit cage");
  document.changed_source().kept = std::exchange(document.changed_pose(), pose::rest_pose(*document.cage()));
  if (document.selection().kind() == ElementKind::probe)
    document.changed_selection() = Selection(ElementKind::vertex);
}

void end_cage_editing(Document& document) {
  record_edit(document, "stop editing cage");
  document.changed_pose() = *std::exchange(document.changed_source().kept, std::nullopt);
}

bool has_moved_rest(const Document& document) {
  return is_editing_cage(document) && document.pose().positions != document.cage()->surface.positions;
}

bool commit_cage_edit(Document& document) {
  if (!has_moved_rest(document)) return false;
  try {
    const Selection selection = document.selection();
    put_edited(document, with_positions(document.cage()->surface, document.pose().positions), "");
    document.changed_selection() = selection;
    return true;
  } catch (const base::Error& error) {
    // Undoes the edit that moved the vertices, and later changes of the selection.
    while (document.history().can_undo() && has_moved_rest(document)) undo(document);
    throw base::Error("", "the result is not a valid cage: " + error.problem(), "the cage was not changed");
  }
}

void split_selected(Document& document) {
  const auto edges = selected_edges(document);
  require(!edges.empty(), "no edge of the cage is selected", "select edges, or both end vertices of an edge");
  put_edited(document, cages::split_edges(document.cage()->surface, edges), "split edges");
}

void cut_selected(Document& document) {
  const auto polygons = selected_polygons(document);
  require(!polygons.empty(), "no face of the cage is selected", "select faces, or all vertices of a face");
  put_edited(document, cages::cut_polygons(document.cage()->surface, polygons), "cut faces");
}

void merge_selected(Document& document) {
  const auto vertices = selected_vertices(*document.cage(), document.selection());
  require(vertices.size() > 1, "fewer than two vertices are selected", "select the vertices to merge");
  put_edited(document, cages::merge_vertices(document.cage()->surface, vertices), "merge vertices");
}

void remove_selected(Document& document) {
  const mesh::Surface& cage = document.cage()->surface;
  const Selection& selection = document.selection();
  const auto put = [&](cages::Edited edited, const char* label) {
    require(edited.surface.corners != cage.corners,
            "the boundary around the selection is not a single loop, so the selection cannot be removed",
            "remove faces instead");
    put_edited(document, std::move(edited), label);
  };
  if (selection.kind() == ElementKind::vertex)
    return put(cages::dissolve_vertices(cage, selection.indices()), "remove vertices");
  if (selection.kind() == ElementKind::edge)
    return put(cages::dissolve_edges(cage, selected_edges(document)), "remove edges");
  put(cages::remove_polygons(cage, selection.indices()), "remove faces");
}

void extrude_selected(Document& document) {
  constexpr double distance = 0.05;  // relative to the cage's diagonal
  const auto polygons = selected_polygons(document);
  require(!polygons.empty(), "no face of the cage is selected", "select faces, or all vertices of a face");
  put_edited(document,
             cages::extrude(document.cage()->surface, polygons, distance * document.cage()->diagonal),
             "extrude faces");
}

void subdivide_cage(Document& document) {
  constexpr std::size_t most_vertices = 20000;
  require(document.cage()->surface.positions.size() < most_vertices / 4,
          "the cage would have too many vertices", "a cage may have at most 20,000 vertices");
  put_edited(document, cages::subdivide(document.cage()->surface), "subdivide cage");
}

void mirror_cage(Document& document) {
  const auto axis = static_cast<std::size_t>(symmetry_axis(document));
  cages::Plane plane{{0, 0, 0}, document.model().bounds.center()[axis]};
  plane.normal[axis] = 1;
  // If vertices are selected, keeps the side of the plane with most of the selection.
  const auto& rest = document.cage()->surface.positions;
  double sum = 0;
  for (const auto v : selected_vertices(*document.cage(), document.selection()))
    sum += rest[v][axis] - plane.offset;
  if (sum < 0) plane = {-1 * plane.normal, -plane.offset};
  put_edited(document, cages::mirrored(document.cage()->surface, plane), "mirror cage", {plane});
}

void fit_cage(Document& document) {
  require(document.model().bounds.diagonal() > 0, "the model is a single point, so no cage can be fitted",
          "move the cage yourself");
  const mesh::Surface& cage = document.cage()->surface;
  cages::Fitted fitted = cages::fitted_to_box(cage, *document.model().surface, fit_margin);
  put_edited(document, with_positions(cage, std::move(fitted.positions)), "fit cage to model",
             {{}, fitted.scale});
}

std::size_t enclose_model(Document& document) {
  const mesh::Surface& cage = document.cage()->surface;
  require(document.cage()->closed, "the cage is open, so it has no inside", "close its holes first");
  cages::Enclosing enclosing = cages::enclose(cage, *document.model().surface, snug_margin);
  if (enclosing.positions != cage.positions)
    put_edited(document, with_positions(cage, std::move(enclosing.positions)), "enclose model");
  return enclosing.left;
}

}  // namespace viete::document
