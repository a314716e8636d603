#include "scene/document/edit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene/document/elements.h"
#include "scene/document/pose_edit.h"
#include "scene/document/probes.h"
#include "scene/document/selection_sets.h"

namespace viete::scene {

namespace {

constexpr const char* change_blending = "change blending";
constexpr const char* change_reach = "change reach";
constexpr const char* change_radius = "change radius";
constexpr const char* change_exponent = "change exponent";
constexpr const char* change_amounts = "change how much turns and stretches";
constexpr const char* change_holding = "change what holds the model";
constexpr const char* change_iterations = "change stitching";

void slide_scheme(Document& document, const deform::Scheme& scheme, const char* label) {
  record_step(document, label);
  put_scheme(document, scheme);
}

}  // namespace

bool differs_from_rest(const Document& document) {
  const auto acts = [](const deform::Probe& p) { return !p.locked && p.pose != deform::ProbePose{}; };
  if (std::ranges::any_of(document.probes.all, acts)) return true;
  if (!document.has_cage()) return false;
  const auto turned = [](const deform::Vec3& t) { return t[0] * t[0] + t[1] * t[1] + t[2] * t[2] > 1; };
  const auto& turns = document.pose.turns;
  return document.pose.positions != document.cage->surface.positions ||
         std::any_of(turns.begin(), turns.end(), turned);
}

void reset_pose(Document& document) {
  document.history.record("reset pose", state_of(document));
  end_mix(document);
  if (document.has_cage()) document.pose = deform::rest_pose(*document.cage);
  for (deform::Probe& probe : document.probes.all) {
    if (!probe.locked) probe.pose = {};
  }
  ++document.revisions.pose;
}

void reset_selected(Document& document, const Mirror* mirror) {
  if (document.selection.kind() == ElementKind::probe) return rest_probes(document);
  document.history.record("reset selected", state_of(document));
  const auto vertices = with_partners(selected_vertices(*document.cage, document.selection), mirror);
  for (const auto v : without_hidden(document, vertices)) {
    document.pose.positions[v] = document.cage->surface.positions[v];
  }
  ++document.revisions.pose;
}

void select_kind(Document& document, ElementKind kind) {
  const bool of_cage = kind != ElementKind::probe && document.selection.kind() != ElementKind::probe;
  set_selection(document, document.has_cage() && of_cage ? converted(*document.cage, document.selection, kind)
                                                         : Selection(kind));
}

void set_method(Document& document, sym3::Method method) {
  if (document.method == method) return;
  document.method = method;
  ++document.revisions.method;
}

void set_scheme(Document& document, const deform::Scheme& scheme) {
  if (document.scheme == scheme) return;
  document.history.record(change_blending, state_of(document));
  put_scheme(document, scheme);
}

void set_reach(Document& document, double reach) {
  deform::Scheme scheme = document.scheme;
  scheme.weighting.reach = reach;
  if (document.scheme.weighting.reach != reach) slide_scheme(document, scheme, change_reach);
}

void set_radius(Document& document, double radius) {
  deform::Scheme scheme = document.scheme;
  scheme.weighting.radius = radius;
  if (document.scheme.weighting.radius != radius) slide_scheme(document, scheme, change_radius);
}

void set_exponent(Document& document, int exponent) {
  deform::Scheme scheme = document.scheme;
  scheme.weighting.exponent = exponent;
  if (document.scheme.weighting.exponent != exponent) slide_scheme(document, scheme, change_exponent);
}

void set_amounts(Document& document, const deform::Amounts& amounts) {
  deform::Scheme scheme = document.scheme;
  scheme.amounts = amounts;
  if (document.scheme.amounts != amounts) slide_scheme(document, scheme, change_amounts);
}

void set_iterations(Document& document, int iterations) {
  deform::Scheme scheme = document.scheme;
  scheme.iterations = iterations;
  if (document.scheme.iterations != iterations) slide_scheme(document, scheme, change_iterations);
}

void set_holding(Document& document, const deform::Holding& holding) {
  deform::Scheme scheme = document.scheme;
  scheme.holding = holding;
  if (document.scheme.holding != holding) slide_scheme(document, scheme, change_holding);
}

void step_reach(Document& document, int step) {
  const auto all = usual_reaches();
  const double now = document.scheme.weighting.reach;
  const auto nearest = static_cast<std::ptrdiff_t>(nearest_reach(now));
  const auto last = static_cast<std::ptrdiff_t>(all.size()) - 1;
  set_reach(document, all[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(nearest + step, 0, last))]);
}

void give_up_scheme(Document& document, const deform::Scheme& instead) {
  History& history = document.history;
  const auto label = history.undo_label();
  static constexpr std::array asks_for_a_binding = {change_reach,    change_radius,     change_exponent,
                                                    change_blending, change_iterations, change_holding};
  const bool chosen_last =
      std::ranges::any_of(asks_for_a_binding, [&](const char* asking) { return label == asking; });
  if (chosen_last && !history.can_redo()) {
    history.drop_last();
  } else {
    history.go_on();  // what is kept of the edits is to be kept anew
  }
  put_scheme(document, instead);
}

std::span<const double> usual_reaches() {
  static constexpr std::array all = {2.0, 2.5, 3.0, 4.0, 6.0, 10.0, deform::whole_cage};
  return all;
}

std::size_t nearest_reach(double reach) {
  const auto all = usual_reaches();
  const auto above = std::lower_bound(all.begin(), all.end(), reach);
  const bool down =
      above != all.begin() && *above > reach && std::log(*above / reach) > std::log(reach / above[-1]);
  return static_cast<std::size_t>(above - all.begin()) - (down ? 1 : 0);
}

}  // namespace viete::scene
