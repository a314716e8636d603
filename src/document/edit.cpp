#include "document/edit.h"

#include <algorithm>
#include <utility>

#include "document/elements.h"
#include "document/pose_edit.h"
#include "document/probes.h"

namespace viete::document {

namespace {

// Settings that require a new binding. The new binding can fail.
enum class Setting : std::size_t { blending, radius, iterations, holding };

EditStep binding_step(Setting setting) {
  return {EditKind::binding, static_cast<std::size_t>(setting)};
}

template <class Place, class Value>
void slide(Document& document, const char* label, EditStep step, const Value& value, const Place& place) {
  pose::Deformer deformer = document.deformer();
  if (std::exchange(*place(deformer), value) == value) return;
  record_step(document, label, step);
  document.put_deformer(deformer);
}

}  // namespace

bool differs_from_rest(const Document& document) {
  const auto acts = [](const pose::Probe& p) { return !p.locked && p.pose != pose::ProbePose{}; };
  if (document.shape() || std::ranges::any_of(document.probes().all, acts)) return true;
  if (!document.has_cage()) return false;
  const auto turned = [](const mesh::Vec3& t) { return mesh::squared_norm(t) > 1; };
  return document.pose().positions != document.cage()->surface.positions ||
         std::ranges::any_of(document.pose().turns, turned);
}

void reset_pose(Document& document) {
  record_edit(document, "reset pose");
  end_mix(document);
  document.changed_source().kind = PoseSource::Kind::edited;
  document.put_shape(nullptr);
  if (document.has_cage()) document.changed_pose() = pose::rest_pose(*document.cage());
  for (pose::Probe& probe : document.changed_probes().all) {
    if (!probe.locked) probe.pose = {};
  }
}

void reset_selected(Document& document, const Mirror* mirror) {
  if (document.selection().kind() == ElementKind::probe) return rest_probes(document);
  record_edit(document, "reset selected");
  const auto vertices = with_partners(selected_vertices(*document.cage(), document.selection()), mirror);
  auto& positions = document.changed_pose().positions;
  for (const auto v : without_hidden(document, vertices))
    positions[v] = document.cage()->surface.positions[v];
}

void select_kind(Document& document, ElementKind kind) {
  const bool of_cage = kind != ElementKind::probe && document.selection().kind() != ElementKind::probe;
  set_selection(document, document.has_cage() && of_cage
                              ? converted(*document.cage(), document.selection(), kind)
                              : Selection(kind));
}

void set_deformer(Document& document, const pose::Deformer& deformer) {
  if (document.deformer() == deformer) return;
  record_edit(document, "change blending", binding_step(Setting::blending));
  document.put_deformer(deformer);
}

void set_radius(Document& document, double radius) {
  slide(document, "change radius", binding_step(Setting::radius), radius,
        [](pose::Deformer& deformer) { return &deformer.weighting.radius; });
}

void set_amounts(Document& document, const pose::Amounts& amounts) {
  slide(document, "change rotation and stretch amounts", {EditKind::amounts}, amounts,
        [](pose::Deformer& deformer) { return &deformer.amounts; });
}

void set_iterations(Document& document, int iterations) {
  slide(document, "change ARAP", binding_step(Setting::iterations), iterations,
        [](pose::Deformer& deformer) { return &deformer.iterations; });
}

void set_holding(Document& document, const pose::Holding& holding) {
  slide(document, "change ARAP constraints", binding_step(Setting::holding), holding,
        [](pose::Deformer& deformer) { return &deformer.holding; });
}

void revert_deformer(Document& document, const pose::Deformer& instead) {
  History& history = document.changed_history();
  const auto last = history.last_step();
  if (last && last->kind == EditKind::binding) {
    history.drop_last();
  } else {
    history.extend_last();
  }
  document.put_deformer(instead);
}

}  // namespace viete::document
