#include "scene/workspace/check_view.h"

#include <algorithm>
#include <utility>

namespace viete::scene {

namespace {

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
