// What views beside the first one show: part of how a document is looked at.
#pragma once

#include <vector>

#include "deform/scheme.h"
#include "lab/field.h"
#include "scene/document/camera.h"
#include "sym3/exp.h"

namespace viete::scene {

/// One view beside the first, which is as the document says.
struct SideWay {
  deform::Scheme scheme;
  sym3::Method method = sym3::Method::fast;
  lab::Field field = lab::Field::none;
  /// What keys and sliders make is there in straight lines where the document has it in log space, and the
  /// other way round.
  bool other_lines = false;

  friend bool operator==(const SideWay&, const SideWay&) = default;
};

struct SideWays {
  static constexpr std::size_t most = 3;
  static constexpr double least_part = 0.05;

  std::vector<SideWay> sides;       ///< none: the view is whole; `most` at most
  bool wipe = false;                ///< two views in one place, on either side of a line
  double line = 0.5;                ///< where that is, as a part of the width, least_part to 1 - least_part
  std::vector<CameraPose> cameras;  ///< of each of `sides`; none: all see what the first one does

  friend bool operator==(const SideWays&, const SideWays&) = default;
};

}  // namespace viete::scene
