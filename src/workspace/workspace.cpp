#include "workspace/workspace.h"

#include <algorithm>

#include "document/elements.h"
#include "pose/deformer.h"

namespace viete::workspace {

namespace {

std::vector<glm::vec3> in_view(const document::Space& space, std::span<const mesh::Point> points) {
  std::vector<glm::vec3> seen;
  seen.reserve(points.size());
  for (const auto& p : points) seen.push_back(space.to_view(p));
  return seen;
}

std::vector<mesh::Point> corners(const mesh::Bounds& box) {
  std::vector<mesh::Point> points;
  for (int i = 0; i < 8; ++i)
    points.push_back(
        {(i & 1 ? box.high : box.low)[0], (i & 2 ? box.high : box.low)[1], (i & 4 ? box.high : box.low)[2]});
  return points;
}

mesh::Bounds cube_around(const mesh::Point& center, double half) {
  const mesh::Vec3 corner{half, half, half};
  return {center - corner, center + corner};
}

// The posed positions of all vertices that belong to triangles of the cage.
std::vector<mesh::Point> element_points(const pose::Cage& cage, const pose::Pose& pose) {
  std::vector<bool> used(pose.positions.size());
  for (const auto& t : cage.surface.triangles)
    for (const auto v : t) used[v] = true;
  std::vector<mesh::Point> points;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) points.push_back(pose.positions[v]);
  return points;
}

// The corners of cubes around the selected probes. The edge length is the largest radius of the probe.
std::vector<mesh::Point> around_probes(const document::Document& document) {
  std::vector<mesh::Point> points;
  for (const auto i : document.selection().indices()) {
    const pose::Probe& probe = document.probes().all[i];
    const double half = 0.5 * std::max({probe.turn.radius, probe.stretch.radius, probe.move.radius});
    const auto box = corners(cube_around(probe_center(document, i), half));
    points.insert(points.end(), box.begin(), box.end());
  }
  return points;
}

void widen(std::vector<glm::vec3>& points) {
  constexpr float least = 0.12F;  // in view units: the model's diagonal is 2
  const glm::vec3 middle = document::center_of(points);
  for (int k = 0; k < 3; ++k) {
    glm::vec3 offset(0);
    offset[k] = least;
    points.push_back(middle + offset);
    points.push_back(middle - offset);
  }
}

// The first deformer that no view uses. If views use all deformers, returns the document's deformer.
pose::Deformer unused_deformer(const Workspace& w) {
  const auto is_used = [&](const pose::Deformer& deformer) {
    for (std::size_t view = 0; view < w.view.split.count(); ++view)
      if (view_settings(w, view).deformer == deformer) return true;
    return false;
  };
  for (const auto preset : base::all_values<pose::Preset>()) {
    const pose::Deformer deformer = pose::deformer_of(preset, w.document.deformer());
    if (!is_used(deformer)) return deformer;
  }
  return w.document.deformer();
}

}  // namespace

std::size_t running_times(const Workspace& w) {
  if (pose::engine_for(w.document.deformer(), w.document.method()) == pose::EngineKind::fused)
    return MethodTimes::fused;
  return static_cast<std::size_t>(std::ranges::find(compared_methods, w.document.method()) -
                                  compared_methods.begin());
}

document::SideView view_settings(const Workspace& w, std::size_t view) {
  if (view > 0) return w.view.split.views[view];
  return {w.document.deformer(), w.document.method(), w.view.options.field};
}

analysis::Field shown_field(const Workspace& w, std::size_t view) {
  const document::SideView settings = view_settings(w, view);
  const analysis::Source source = analysis::entry(settings.field).source;
  const bool exponential = w.document.has_cage() && settings.deformer.exponential();
  const bool exists = source == analysis::Source::surface || source == analysis::Source::first
                          ? w.document.model().surface != nullptr
                      : source == analysis::Source::matrices ? exponential
                                                             : w.document.is_movable();
  const bool lacks_faces = analysis::entry(settings.field).needs_faces && !w.document.has_faces();
  return exists && !lacks_faces && !shows_mask(w) ? settings.field : analysis::Field::none;
}

namespace {

// True if the outer box contains the middle half of the inner box. A cage can be tight in places.
bool contains(const mesh::Bounds& outer, const mesh::Bounds& inner) {
  for (std::size_t a = 0; a < 3; ++a) {
    const double quarter = 0.25 * (inner.high[a] - inner.low[a]);
    if (outer.low[a] > inner.low[a] + quarter || outer.high[a] < inner.high[a] - quarter) return false;
  }
  return true;
}

}  // namespace

std::vector<files::RecoveryFile> Recovery::offers() const {
  std::vector<files::RecoveryFile> unseen = files;
  std::erase_if(unseen, [](const files::RecoveryFile& file) { return file.restored; });
  return unseen.empty() ? files : unseen;
}

static bool may_offer_cage(const Workspace& w) {
  return w.panels.offer_cage && w.view.options.panels && w.document.model().surface && !w.making.open;
}

const document::Finding* offered_finding(const Workspace& w) {
  const bool begun = w.document.history().can_undo() || w.document.kept_pose();
  if (!w.document.has_cage() || w.checks.running || w.view.interaction.drag) return nullptr;
  if (begun && !w.checks.pushed_out) return nullptr;
  const auto at = outside_finding(w.checks);
  return at ? &w.checks.findings[*at] : nullptr;
}

bool offers_next_step(const Workspace& w) {
  return may_offer_cage(w) && !w.jobs.loading.running &&
         (!w.document.is_movable() || offered_finding(w) != nullptr);
}

float offer_height(const Workspace& w) {
  constexpr float usual = 152, with_cage_beside = 198;
  if (!may_offer_cage(w) || w.document.is_movable()) return 0;
  const float height = w.document.cage_beside().empty() ? usual : with_cage_beside;
  return std::min(height, 0.5f * w.view.camera.viewport.size.y);
}

void frame_all(Workspace& w, bool eased) {
  const document::Document& document = w.document;
  if (!document.model().surface) return;
  // Usually the cage encloses the model, so that it is enough to show the cage.
  std::vector<mesh::Point> points;
  if (document.has_cage()) points = element_points(*document.cage(), document.pose());
  const mesh::Bounds& model = document.model().bounds;
  if (!document.has_cage() || !contains(document.cage_file().bounds, model))
    std::ranges::copy(corners(model), std::back_inserter(points));
  w.view.camera.frame(in_view(document.space(), points), eased, offer_height(w));
}

void frame_other_cage(Workspace& w) {
  if (!w.document.has_cage()) return;
  const mesh::Bounds &cage = w.document.cage_file().bounds, &model = w.document.model().bounds;
  if (!contains(cage, model) || cage.diagonal() > 2 * model.diagonal()) frame_all(w, true);
}

void frame_selection(Workspace& w, bool eased) {
  const document::Document& document = w.document;
  if (document.selection().empty()) return frame_all(w, eased);
  std::vector<mesh::Point> points;
  for (const auto v : moving_vertices(document)) points.push_back(document.pose().positions[v]);
  if (document.selection().kind() == document::ElementKind::probe) points = around_probes(document);
  w.view.camera.frame(in_view(document.space(), points), eased);
}

void frame_worst(Workspace& w) {
  constexpr double share = 0.06;  // half the visible size, as a fraction of the model's diagonal
  const auto& surface = *w.document.model().surface;
  const std::size_t worst = w.view.split.views[0].shown.stats.worst;
  if (worst >= surface.positions.size()) return;
  const auto box =
      cube_around(w.frame.posed.at(surface, worst), share * w.document.model().bounds.diagonal());
  w.view.camera.frame(in_view(w.document.space(), corners(box)), true);
}

void toggle_finding(Workspace& w, std::size_t index) {
  CheckState& checks = w.checks;
  const bool hide = checks.shown == index;
  checks.show(hide ? std::nullopt : std::optional(index));
  if (!hide) w.jobs.wishes.add(FrameFinding{});
}

void step_element(Workspace& w, int step) {
  CheckState& checks = w.checks;
  if (!checks.shown) return;
  const std::size_t n = checks.findings[*checks.shown].size();
  const std::size_t first = step > 0 ? 0 : n - 1;
  checks.show(checks.shown, checks.element ? (*checks.element + (step > 0 ? 1 : n - 1)) % n : first);
  w.jobs.wishes.add(FrameFinding{});
}

void frame_finding(Workspace& w) {
  const CheckState& checks = w.checks;
  if (!checks.shown) return;
  constexpr std::size_t enough = 20000;
  const document::Finding& finding = checks.findings[*checks.shown];
  const document::Document& document = w.document;
  const bool of_cage = finding.subject == document::Subject::cage;
  const mesh::Surface& surface = of_cage ? *document.cage_file().surface : *document.model().surface;
  std::vector<glm::vec3> points;
  for (const auto e : shown_elements(checks, enough))
    for (const auto v : vertices_of(finding, surface, e))
      points.push_back(
          document.space().to_view(of_cage ? document.pose().positions[v] : w.frame.posed.at(surface, v)));
  widen(points);
  w.view.camera.frame(points, true);
}

void begin_widget_edit(Workspace& w) {
  w.panels.before_edit = {mark_of(w.document), w.view.handling,      w.view.brush,
                          w.making.wish,       w.preferences.layout, w.files.opened};
}

// During cage generation, restores only settings. With these settings, the previous cage is generated again.
void cancel_widget_edit(Workspace& w) {
  if (!w.panels.before_edit || w.panels.before_edit->opened != w.files.opened) return;
  BeforeWidgetEdit before = *std::exchange(w.panels.before_edit, std::nullopt);
  w.view.handling = before.handling;
  w.view.brush = before.brush;
  w.making.wish = before.wish;
  w.preferences.layout = before.layout;
  if (!w.making.open) take_back(w.document, std::move(before.document));
}

void take_report(Workspace& w, const pose::LogReport& report) {
  document::Document& document = w.document;
  document.put_drawn_turns(report.turns);
  w.frame.notes = document::pose_notes(report, *document.cage(), document.pose());
  w.frame.report = report;
}

void split_view(Workspace& w, std::size_t count) {
  Split& split = w.view.split;
  count = std::clamp<std::size_t>(count, 1, Split::most);
  enter_view(w, 0);
  if (!split.on() && count > 1) split.before = w.view.camera.destination();
  if (split.on() && count == 1 && split.before)
    w.view.camera.set_pose(*std::exchange(split.before, std::nullopt));
  split.views.resize(std::min(count, split.count()));
  while (split.count() < count)
    split.views.push_back({{unused_deformer(w), w.document.method(), w.view.options.field}});
  split.cameras.assign(split.count(), w.view.camera.pose());
  w.view.camera.viewport = viewport_of(split, w.view.camera.viewport, 0);
}

void enter_view(Workspace& w, std::size_t view) {
  Split& split = w.view.split;
  if (view == split.active || view >= split.count()) return;
  split.cameras.resize(split.count(), w.view.camera.pose());
  if (!split.linked) {
    split.cameras[split.active] = w.view.camera.pose();
    w.view.camera.set_pose(split.cameras[view]);
  }
  split.active = view;
  w.view.camera.viewport = viewport_of(split, w.view.camera.viewport, view);
}

document::CameraPose camera_of(const Workspace& w, std::size_t view) {
  const Split& split = w.view.split;
  const bool own = !split.linked && view != split.active && view < split.cameras.size();
  return own ? split.cameras[view] : w.view.camera.pose();
}

document::CameraPose last_camera_of(const Workspace& w, std::size_t view) {
  const Split& split = w.view.split;
  return split.linked || view == split.active ? w.view.camera.destination() : camera_of(w, view);
}

document::SideViews side_views(const Workspace& w) {
  const Split& split = w.view.split;
  document::SideViews sides;
  for (const SplitView& view : split.sides()) sides.sides.push_back(view);
  if (!split.linked)
    for (std::size_t view = 1; view < split.count(); ++view) sides.cameras.push_back(last_camera_of(w, view));
  return sides;
}

document::Viewport viewport_of(const Split& split, const document::Viewport& whole, std::size_t view) {
  const glm::ivec2 grid = split.count() == 4 ? glm::ivec2(2, 2) : glm::ivec2(int(split.count()), 1);
  const int at = static_cast<int>(view);
  document::Viewport seen = whole;
  seen.pane_size = 1.0f / glm::vec2(grid);
  seen.pane = seen.pane_size * glm::vec2(at % grid.x, at / grid.x);
  return seen;
}

void put_side_views(Split& split, const document::SideViews& sides) {
  split.views.resize(1);
  for (const document::SideView& side : sides.sides) split.views.push_back({side});
  split.active = 0;
  split.before.reset();
  if (split.on()) split.linked = sides.cameras.empty();
  split.cameras = sides.cameras;
  if (!split.linked)
    split.cameras.insert(split.cameras.begin(), document::CameraPose{});  // for the active view; unused
}

std::size_t view_at(const Split& split, const document::Viewport& whole, const glm::vec2& place) {
  const glm::vec2 at = (place - whole.origin) / whole.size;
  for (std::size_t view = 0; view < split.count(); ++view) {
    const document::Viewport v = viewport_of(split, whole, view);
    if (glm::all(glm::greaterThanEqual(at, v.pane)) && glm::all(glm::lessThan(at, v.pane + v.pane_size)))
      return view;
  }
  return split.active;
}

void forget_findings(CheckState& checks) {
  take_findings(checks, {});
  checks.fresh = false;
}

void take_findings(CheckState& checks, std::vector<document::Finding> findings) {
  checks.findings = std::move(findings);
  checks.show(std::nullopt);
  checks.fresh = true;
}

std::optional<std::size_t> outside_finding(const CheckState& checks) {
  const auto found = std::ranges::find_if(checks.findings, [](const document::Finding& f) {
    return f.defect == document::Defect::vertices_outside && f.subject == document::Subject::model;
  });
  if (found == checks.findings.end()) return std::nullopt;
  return static_cast<std::size_t>(found - checks.findings.begin());
}

std::vector<std::size_t> shown_elements(const CheckState& checks, std::size_t most) {
  if (!checks.shown) return {};
  if (checks.element) return {*checks.element};
  const std::size_t all = checks.findings[*checks.shown].size(), count = std::min(all, most);
  std::vector<std::size_t> elements(count);
  for (std::size_t i = 0; i < count; ++i) elements[i] = i * all / count;
  return elements;
}

}  // namespace viete::workspace
