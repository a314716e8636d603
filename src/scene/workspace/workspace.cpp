#include "scene/workspace/workspace.h"

#include <algorithm>

#include "deform/scheme.h"
#include "scene/document/checks.h"
#include "scene/document/elements.h"
#include "scene/document/probes.h"
#include "scene/document/selection_sets.h"

namespace viete::scene {

namespace {

std::vector<glm::vec3> in_view(const Space& space, std::span<const mesh::Point> points) {
  std::vector<glm::vec3> seen;
  seen.reserve(points.size());
  for (const auto& p : points) seen.push_back(space.to_view(p));
  return seen;
}

// The corners of the box of used vertices: stray vertices must not enlarge it.
std::vector<mesh::Point> corners(const mesh::Bounds& box) {
  std::vector<mesh::Point> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(
        {(i & 1 ? box.high : box.low)[0], (i & 2 ? box.high : box.low)[1], (i & 4 ? box.high : box.low)[2]});
  }
  return points;
}

// The positions used by the cage's elements; unused vertices are ignored.
std::vector<mesh::Point> element_points(const deform::Cage& cage, const deform::Pose& pose) {
  std::vector<bool> used(pose.positions.size());
  for (const auto& t : cage.surface.triangles) {
    for (const auto v : t) used[v] = true;
  }
  std::vector<mesh::Point> points;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) points.push_back(pose.positions[v]);
  }
  return points;
}

// The corners of boxes around the selected probes, with their largest radius.
std::vector<mesh::Point> around_probes(const Document& document) {
  std::vector<mesh::Point> points;
  for (const auto i : document.selection.indices()) {
    const deform::Probe& probe = document.probes.all[i];
    const double half = 0.5 * std::max({probe.turn.radius, probe.stretch.radius, probe.move.radius});
    const mesh::Point center = probe_center(document, i);
    for (int corner = 0; corner < 8; ++corner) {
      mesh::Point p = center;
      for (std::size_t k = 0; k < 3; ++k) p[k] += (corner >> k & 1) ? half : -half;
      points.push_back(p);
    }
  }
  return points;
}

}  // namespace

bool shows_links(const Workspace& w) {
  return deform::engine_for(w.document.scheme, w.document.method, w.view.same_path) ==
         deform::EngineKind::staged;
}

lab::Field shown_field(const Workspace& w, lab::Field field, const deform::Scheme& scheme) {
  const lab::Source source = lab::entry(field).source;
  const bool exponential = w.document.has_cage() && scheme.exponential();
  const bool exists = source == lab::Source::surface || source == lab::Source::first
                          ? w.document.model.surface != nullptr
                      : source == lab::Source::matrices ? exponential
                                                        : w.document.is_movable();
  return exists && !shows_mask(w) ? field : lab::Field::none;
}

lab::Field shown_field(const Workspace& w) {
  return shown_field(w, w.view.field, w.document.scheme);
}

float offer_height(const Workspace& w) {
  constexpr float usual = 152, with_cage_beside = 198;
  const bool offered =
      w.offer_cage && w.view.panels && w.document.model.surface && !w.making.open && !w.document.is_movable();
  if (!offered) return 0;
  const float height = w.document.cage_beside.empty() ? usual : with_cage_beside;
  return std::min(height, 0.5f * w.viewport.size.y);
}

void frame_all(Workspace& workspace, bool eased) {
  const Document& document = workspace.document;
  if (!document.model.surface) return;
  // A cage encloses its model: its vertices cover both.
  const std::vector<mesh::Point> points =
      document.has_cage() ? element_points(*document.cage, document.pose) : corners(document.model.bounds);
  workspace.camera.frame(in_view(document.space, points), workspace.viewport, eased, offer_height(workspace));
}

void frame_selection(Workspace& workspace, bool eased) {
  const Document& document = workspace.document;
  if (document.selection.empty()) return frame_all(workspace, eased);
  std::vector<mesh::Point> points;
  for (const auto v : moving_vertices(document)) points.push_back(document.pose.positions[v]);
  if (document.selection.kind() == ElementKind::probe) points = around_probes(document);
  workspace.camera.frame(in_view(document.space, points), workspace.viewport, eased);
}

void frame_worst(Workspace& w) {
  constexpr double share = 0.06;  // fraction of the model's diagonal, on either side
  const auto& surface = *w.document.model.surface;
  const std::size_t worst = w.field.stats.worst;
  if (worst >= surface.positions.size()) return;
  const mesh::Point at = w.posed.vertices.empty() ? surface.positions[worst] : w.posed.at(surface, worst);
  const double half = share * w.document.model.bounds.diagonal();
  const mesh::Bounds box{at - mesh::Vec3{half, half, half}, at + mesh::Vec3{half, half, half}};
  w.camera.frame(in_view(w.document.space, corners(box)), w.viewport, true);
}

void begin_widget_edit(Workspace& w) {
  w.before_widget_edit = {mark_of(w.document), w.handling,           w.brush,
                          w.making.wish,       w.preferences.layout, w.opened};
}

// Keeps a cage that is being generated: it follows the settings and is not part of the edit.
void cancel_widget_edit(Workspace& w) {
  if (!w.before_widget_edit || w.before_widget_edit->opened != w.opened) return;
  BeforeWidgetEdit before = *std::exchange(w.before_widget_edit, std::nullopt);
  w.handling = before.handling;
  w.brush = before.brush;
  w.making.wish = before.wish;
  w.preferences.layout = before.layout;
  if (!w.making.open) take_back(w.document, std::move(before.document));
}

std::optional<double> TimeLeft::of(const WorkState& work) {
  if (work.what != what_ ||
      (!seen_.empty() && (work.seconds < seen_.back()[0] || work.done < seen_.back()[1])))
    seen_.clear();
  what_ = work.what;
  constexpr double apart = 0.05;
  if (seen_.empty() || work.seconds > seen_.back()[0] + apart) seen_.push_back({work.seconds, work.done});
  if (work.seconds < 0.5 || work.done < 0.02) return std::nullopt;
  const auto half =
      std::ranges::lower_bound(seen_, 0.5 * work.seconds, {}, [](const auto& s) { return s[0]; });
  const double seconds = work.seconds - (*half)[0], done = work.done - (*half)[1];
  if (seconds < 0.2 || !(done > 0)) return work.seconds * (1 - work.done) / work.done;
  return seconds * (1 - work.done) / done;
}

void take_report(Workspace& workspace, const deform::LogReport& report) {
  Document& document = workspace.document;
  document.pose.turns = report.turns;
  workspace.pose_notes = pose_notes(report, *document.cage, document.pose);
  workspace.pose_report = report;
}

}  // namespace viete::scene
