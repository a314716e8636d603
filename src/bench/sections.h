// The sections of the page: text, drawings, numbers and the commands that repeat them.
#pragma once

#include <string>
#include <vector>

#include "bench/figures.h"

namespace viete::bench {

struct Section {
  std::string id, origin, title;  ///< origin: the source of the figure
  std::string seen;               ///< one or two sentences on the result
  std::string why;
  std::string body;  ///< HTML: drawings and tables
  std::vector<std::string> commands;
};

/// The paper's three figures and its claims, then ours.
std::vector<Section> sections_of(const Figures& figures);
Section eigenvalues_section(const Figures& figures);
Section exponentials_section(const Figures& figures);
Section deformation_section(const Figures& figures);
Section paper_section(const Figures& figures);
Section accuracy_section(const Figures& figures);
Section frames_section(const Figures& figures);
Section ways_section(const Figures& figures);
Section shapes_section(const Figures& figures);

}  // namespace viete::bench
