// What of a cage is hidden, and sets of its vertices by name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/document/selection.h"

namespace viete::scene {

/// What was selected once, to be selected again: elements of this kind with all their vertices among these.
struct NamedSet {
  std::string name;
  ElementKind kind = ElementKind::vertex;  ///< no probes
  std::vector<std::uint32_t> vertices;     ///< ascending, each once

  friend bool operator==(const NamedSet&, const NamedSet&) = default;
};

struct CageGroups {
  /// Vertices, ascending, each once: elements without any other one are neither shown nor selected, and none
  /// of these is moved by hand.
  std::vector<std::uint32_t> hidden;
  std::vector<NamedSet> sets;

  friend bool operator==(const CageGroups&, const CageGroups&) = default;
};

}  // namespace viete::scene
