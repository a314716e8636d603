#include "scene/workspace/check_state.h"

#include <algorithm>
#include <utility>

#include "scene/workspace/workspace.h"

namespace viete::scene {

namespace {

// Frames some surroundings too: a single edge of a fine mesh gives no orientation.
FoundKind kind_of(const Finding& finding) {
  return {finding.defect, finding.subject};
}

void show_badge(CheckState& checks) {
  checks.badge.reset();
  for (const Finding& finding : checks.findings) {
    const FoundKind kind = kind_of(finding);
    if (!matters(finding) || std::ranges::find(checks.dismissed, kind) != checks.dismissed.end()) continue;
    checks.badge = {kind, title(finding)};
    return;
  }
}

const mesh::Surface& surface_of(const Document& document, const Finding& finding) {
  return finding.subject == Subject::cage ? *document.cage_file.surface : *document.model.surface;
}

void widen(std::vector<glm::vec3>& points) {
  constexpr float least = 0.12F;  // for a model of size 2
  glm::vec3 low = points[0], high = points[0];
  for (const auto& p : points) low = glm::min(low, p), high = glm::max(high, p);
  const glm::vec3 middle = 0.5F * (low + high);
  for (int k = 0; k < 3; ++k) {
    glm::vec3 offset(0);
    offset[k] = least;
    points.push_back(middle + offset);
    points.push_back(middle - offset);
  }
}

}  // namespace

// The badge stays until the checks find that it no longer applies.
void forget_findings(CheckState& checks) {
  const auto badge = checks.badge;
  take_findings(checks, {});
  checks.fresh = false;
  checks.badge = badge;
}

void take_findings(CheckState& checks, std::vector<Finding> findings) {
  checks.findings = std::move(findings);
  checks.show(std::nullopt);
  checks.fresh = true;
  show_badge(checks);
}

void dismiss_badge(CheckState& checks) {
  if (!checks.badge) return;
  checks.dismissed.push_back(checks.badge->kind);
  show_badge(checks);
}

std::string_view remedy(const CheckBadge& badge) {
  return badge.kind.defect == Defect::vertices_outside ? "enclose_model" : "";
}

std::optional<std::size_t> find_finding(const CheckState& checks, const FoundKind& kind) {
  const auto found =
      std::ranges::find_if(checks.findings, [&](const Finding& f) { return kind_of(f) == kind; });
  if (found == checks.findings.end()) return std::nullopt;
  return static_cast<std::size_t>(found - checks.findings.begin());
}

std::optional<std::size_t> outside_finding(const CheckState& checks) {
  return find_finding(checks, {Defect::vertices_outside, Subject::model});
}

std::vector<std::size_t> shown_elements(const CheckState& checks, std::size_t most) {
  if (!checks.shown) return {};
  if (checks.element) return {*checks.element};
  const std::size_t all = checks.findings[*checks.shown].size(), count = std::min(all, most);
  std::vector<std::size_t> elements(count);
  for (std::size_t i = 0; i < count; ++i) elements[i] = i * all / count;
  return elements;
}

void toggle_finding(Workspace& workspace, std::size_t index) {
  CheckState& checks = workspace.checks;
  const bool hide = checks.shown == index;
  checks.show(hide ? std::nullopt : std::optional(index));
  workspace.requests.frame_finding = !hide;
}

void step_element(Workspace& workspace, int step) {
  CheckState& checks = workspace.checks;
  if (!checks.shown) return;
  const std::size_t n = checks.findings[*checks.shown].size();
  const std::size_t first = step > 0 ? 0 : n - 1;
  checks.show(checks.shown, checks.element ? (*checks.element + (step > 0 ? 1 : n - 1)) % n : first);
  workspace.requests.frame_finding = true;
}

void frame_finding(Workspace& workspace, std::span<const mesh::Point> positions) {
  const CheckState& checks = workspace.checks;
  if (!checks.shown) return;
  constexpr std::size_t enough = 20000;
  const Finding& finding = checks.findings[*checks.shown];
  std::vector<glm::vec3> points;
  for (const auto e : shown_elements(checks, enough)) {
    for (const auto v : vertices_of(finding, surface_of(workspace.document, finding), e)) {
      points.push_back(workspace.document.space.to_view(positions[v]));
    }
  }
  widen(points);
  workspace.camera.frame(points, workspace.viewport, true);
}

}  // namespace viete::scene
