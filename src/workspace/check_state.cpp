#include "workspace/check_state.h"

#include <algorithm>
#include <utility>

namespace viete::workspace {

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
