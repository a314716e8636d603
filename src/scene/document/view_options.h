// The view of a document: what it shows, and how; and what views beside the first one show.
#pragma once

#include <vector>

#include "base/choice.h"
#include "deform/scheme.h"
#include "lab/field.h"
#include "scene/document/camera.h"
#include "sym3/exp.h"

namespace viete::scene {

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

/// What the model is coloured by.
enum class Shading { clay, porcelain, jade, file, checker, normals, zebra };

std::span<const Choice> choices(Shading);

struct ViewOptions {
  bool dark = true;
  bool model = true;
  bool deformed = true;             ///< as cage and probes move it; else at rest, whatever they do
  Shading shading = Shading::file;  ///< clay, where the file says nothing
  bool wireframe = false;
  bool cage = true;
  bool grid = true;
  bool axes = true;                     ///< the axis widget
  bool ghost = false;                   ///< the rest pose of the cage, faintly, while the cage is posed
  lab::Field field = lab::Field::none;  ///< as colours on the mesh
  bool select_visible = false;          ///< what model or cage hide is not selected with the mouse
  bool same_path = false;               ///< method `fast` runs link by link in double, too, as the others do
  bool panels = true;
  bool help = false;
  bool hints = true;  ///< of the first start; gone after the first drag

  friend bool operator==(const ViewOptions&, const ViewOptions&) = default;
};

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
