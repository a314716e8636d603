#include "scene/edit.h"

#include <algorithm>
#include <utility>

#include "scene/elements.h"

namespace viete::scene {

namespace {

void restore(Document& document, Snapshot&& snapshot) {
  document.pose = std::move(snapshot.pose);
  document.selection = std::move(snapshot.selection);
  ++document.posed;
}

}  // namespace

bool differs_from_rest(const Document& document) {
  if (!document.has_cage()) return false;
  const auto turned = [](const deform::Vec3& t) { return t[0] * t[0] + t[1] * t[1] + t[2] * t[2] > 1; };
  const auto& turns = document.pose.turns;
  return document.pose.positions != document.cage->surface.positions ||
         std::any_of(turns.begin(), turns.end(), turned);
}

void reset_pose(Document& document) {
  document.history.record("reset pose", {document.pose, document.selection});
  document.pose = deform::rest_pose(*document.cage);
  ++document.posed;
}

void reset_selected(Document& document) {
  document.history.record("reset selected", {document.pose, document.selection});
  for (const auto v : selected_vertices(*document.cage, document.selection)) {
    document.pose.positions[v] = document.cage->surface.positions[v];
  }
  ++document.posed;
}

void select_kind(Document& document, ElementKind kind) {
  document.selection =
      document.has_cage() ? converted(*document.cage, document.selection, kind) : Selection(kind);
}

void undo(Document& document) {
  restore(document, document.history.undo({document.pose, document.selection}));
}

void redo(Document& document) {
  restore(document, document.history.redo({document.pose, document.selection}));
}

void set_method(Document& document, sym3::Method method) {
  if (document.method == method) return;
  document.method = method;
  ++document.posed;
}

void set_coordinates(Document& document, deform::Coordinates coordinates) {
  if (document.coordinates == coordinates) return;
  document.coordinates = coordinates;
  if (document.has_cage()) ++document.topology;
}

void set_reach(Document& document, double reach) {
  if (document.reach == reach) return;
  document.reach = reach;
  if (document.has_cage() && document.coordinates == deform::Coordinates::face) ++document.topology;
}

}  // namespace viete::scene
