#include "scene/workspace/check_state.h"

#include <algorithm>
#include <utility>

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
    checks.badge = {kind, title(finding), finding.turned};
    return;
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
  if (badge.kind.defect != Defect::vertices_outside) return "";
  return badge.turned ? "fit_cage_turned" : "enclose_model";
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

}  // namespace viete::scene
