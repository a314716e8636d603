#include "cages/subject.h"

#include <algorithm>

namespace viete::cages {

namespace {

// With a mirror, as wide on both sides of x = 0.
FramedModel centered(FramedModel model, bool mirrored) {
  if (!mirrored) return model;
  const double x = std::max(-model.box.low[0], model.box.high[0]);
  model.box.low[0] = -x;
  model.box.high[0] = x;
  return model;
}

}  // namespace

Subject::Subject(const mesh::Surface& surface, const std::optional<Plane>& plane, base::Progress* progress)
    : mirror(plane),
      frame(frame_of(surface, plane)),
      model(centered(model_in(frame, surface), plane.has_value())),
      tree(model.positions, model.triangles, progress) {}

}  // namespace viete::cages
