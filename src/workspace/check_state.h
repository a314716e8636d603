// The results of the checks, and the finding shown in the view.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "document/checks.h"

namespace viete::workspace {

struct CheckState {
  bool running = false;
  double done = 0;  ///< in [0, 1]
  std::vector<document::Finding> findings;
  std::optional<std::size_t> shown;    ///< index of the finding that is highlighted in the view
  std::optional<std::size_t> element;  ///< index of the only highlighted element; nullopt: all elements
  bool fresh = false;                  ///< the findings have not been displayed yet
  std::size_t outside = 0;             ///< model vertices outside the cage that was checked last
  bool pushed_out = false;             ///< the last change of the cage has increased `outside`

  void show(std::optional<std::size_t> finding, std::optional<std::size_t> one = {}) {
    shown = finding;
    element = one;
    ++revision_;
  }
  /// Increases when the findings or the highlighted elements change.
  unsigned long revision() const { return revision_; }

private:
  unsigned long revision_ = 0;
};

/// Clears the findings, for example after a change of the cage.
void forget_findings(CheckState& checks);

/// The index of the finding about model vertices outside the cage; nullopt if all vertices are inside.
std::optional<std::size_t> outside_finding(const CheckState& checks);

/// Replaces the findings. Afterwards no finding is shown.
void take_findings(CheckState& checks, std::vector<document::Finding> findings);

/// Indices of highlighted elements of the shown finding: at most `most`, evenly spread.
std::vector<std::size_t> shown_elements(const CheckState& checks, std::size_t most);

}  // namespace viete::workspace
