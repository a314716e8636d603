// The results of the checks, and the finding shown in the view.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/document/checks.h"

namespace viete::scene {

/// One kind of defect; identifies a finding across repeated checks.
struct FoundKind {
  Defect defect;
  Subject subject;
  friend bool operator==(const FoundKind&, const FoundKind&) = default;
};

/// The badge in the view: the first finding that matters, kept while the checks run again.
struct CheckBadge {
  FoundKind kind;
  std::string title;
  bool turned = false;  ///< see Finding::turned
};

/// The findings about the open document, and the one shown.
struct CheckState {
  bool running = false;
  double done = 0;  ///< in [0, 1]
  std::vector<Finding> findings;
  std::optional<std::size_t> shown;    ///< a finding highlighted in the view
  std::optional<std::size_t> element;  ///< a single element of it; nullopt: all
  bool fresh = false;                  ///< the findings have not been displayed yet
  std::optional<CheckBadge> badge;
  std::vector<FoundKind> dismissed;  ///< dismissed badges for this model and cage

  void show(std::optional<std::size_t> finding, std::optional<std::size_t> one = {}) {
    shown = finding, element = one, ++revision_;
  }
  /// Increases when the findings or the shown one change.
  unsigned long revision() const { return revision_; }

private:
  unsigned long revision_ = 0;
};

/// Clears the findings, for example after a change of the cage.
void forget_findings(CheckState& checks);

/// Dismisses the badge; its kind of defect gets no badge until another model or cage is opened.
void dismiss_badge(CheckState& checks);
/// The command that fixes it; empty: toggle_finding() shows it.
std::string_view remedy(const CheckBadge& badge);
/// The index of the finding of that kind; nullopt: none.
std::optional<std::size_t> find_finding(const CheckState& checks, const FoundKind& kind);

/// The finding about model vertices outside the cage; nullopt: none.
std::optional<std::size_t> outside_finding(const CheckState& checks);

/// Replaces the findings; none is shown.
void take_findings(CheckState& checks, std::vector<Finding> findings);

/// Indices of the shown elements within the finding: at most `most`, evenly spread.
std::vector<std::size_t> shown_elements(const CheckState& checks, std::size_t most);

}  // namespace viete::scene
