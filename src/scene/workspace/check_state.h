// What the checks have found, and which finding is shown.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/document/checks.h"

namespace viete::scene {

/// One kind of defect, whose elements may be looked for anew.
struct FoundKind {
  Defect defect;
  Subject subject;
  friend bool operator==(const FoundKind&, const FoundKind&) = default;
};

/// What stands in the view of the findings, also while they are looked for anew: the first that matters.
struct CheckBadge {
  FoundKind kind;
  std::string title;
  bool turned = false;  ///< as Finding has it
};

/// What the checks have found about the open document, and what of it is shown.
struct CheckState {
  bool running = false;
  double done = 0;  ///< in [0, 1]
  std::vector<Finding> findings;
  std::optional<std::size_t> shown;    ///< a finding, highlighted in the view
  std::optional<std::size_t> element;  ///< one element of it; nothing: all
  bool fresh = false;                  ///< the findings have not been on screen yet
  std::optional<CheckBadge> badge;
  std::vector<FoundKind> put_away;  ///< of which no badge is wanted for this model and cage

  void show(std::optional<std::size_t> finding, std::optional<std::size_t> one = {}) {
    shown = finding, element = one, ++revision_;
  }
  /// Grows with each change of findings or of what is shown.
  unsigned long revision() const { return revision_; }

private:
  unsigned long revision_ = 0;
};

/// Nothing is known any more, as when the cage is another one.
void forget_findings(CheckState& checks);

/// Of what the badge speaks, no other one does until another model or cage is opened.
void put_badge_away(CheckState& checks);
/// The command that helps against it; empty: to see where it is, by toggle_finding().
std::string_view remedy(const CheckBadge& badge);
/// The finding of that kind, if there is one.
std::optional<std::size_t> find_finding(const CheckState& checks, const FoundKind& kind);

/// The one about vertices of the model outside of its cage, if there is one.
std::optional<std::size_t> outside_finding(const CheckState& checks);

/// New findings, nothing shown.
void take_findings(CheckState& checks, std::vector<Finding> findings);

/// The elements that are shown, as numbers of the finding's elements: at most so many, evenly spread.
std::vector<std::size_t> shown_elements(const CheckState& checks, std::size_t most);

}  // namespace viete::scene
