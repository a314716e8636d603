// Lengths, area and volume of the model, posed and at rest.
#pragma once

#include <optional>

#include "scene/document/brush.h"
#include "scene/document/document.h"

namespace viete::scene {

/// In the file's units; volume is of use where the model is closed.
struct Measures {
  double area = 0, volume = 0;
};

/// Of the model as it is drawn, or, without vertices, at rest. O(n).
Measures measure(const Document& document, const PosedModel& posed);

/// Where a point of the model is, drawn or, without vertices, at rest; file coordinates.
mesh::Point place_of(const Document& document, const PosedModel& posed, const SurfacePoint& point);

/// Measured last, and of what.
struct KnownMeasures {
  std::optional<Revisions> of;
  bool posed = false;
  unsigned long frame = 0;
  Measures now;
};

/// The same, measured again only where something has changed since.
const Measures& measure(const Document& document, const PosedModel& posed, KnownMeasures& known);

}  // namespace viete::scene
