// A model as cages are made around it.
#pragma once

#include <optional>

#include "base/progress.h"
#include "cages/frame.h"
#include "cages/mirror.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"

namespace viete::cages {

/// What does not depend on the wish but for the mirror: made once, asked by many. Thread-safe once made.
struct Subject {
  /// The surface has an extent. progress may be null; throws base::Cancelled.
  Subject(const mesh::Surface& surface, const std::optional<Plane>& mirror, base::Progress* progress);

  std::optional<Plane> mirror;
  Frame frame;
  FramedModel model;  ///< with a mirror, its box is as wide on both sides
  mesh::TriangleTree tree;
};

}  // namespace viete::cages
