// View settings of a document, and of the additional views.
#pragma once

#include <vector>

#include "analysis/field.h"
#include "base/choice.h"
#include "deform/scheme.h"
#include "document/camera.h"
#include "sym3/exp.h"

namespace viete::document {

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

/// The model's colouring.
enum class Shading { clay, porcelain, jade, file, checker, normals, zebra };

std::span<const Choice> choices(Shading);

struct ViewOptions {
  bool dark = true;
  bool model = true;
  bool deformed = true;             ///< moved by cage and probes; false: shown at rest
  Shading shading = Shading::file;  ///< clay if the file has no material
  bool wireframe = false;
  bool cage = true;
  bool grid = true;
  bool axes = true;                               ///< the axis widget
  bool ghost = false;                             ///< the cage's rest pose, faint, while the cage is posed
  analysis::Field field = analysis::Field::none;  ///< colour map on the mesh
  bool select_visible = false;  ///< the mouse selects only elements that neither model nor cage hide
  bool same_path = false;       ///< method `fast` also runs step by step in double, like the other methods
  bool panels = true;
  bool hints = true;  ///< at the first start; removed after the first drag

  friend bool operator==(const ViewOptions&, const ViewOptions&) = default;
};

/// An additional view; the first view uses the document's settings.
struct SideWay {
  deform::Scheme scheme;
  sym3::Method method = sym3::Method::fast;
  analysis::Field field = analysis::Field::none;
  /// Mixes poses and interpolates keys linearly if the document uses log space, and vice versa.
  bool other_blending = false;

  friend bool operator==(const SideWay&, const SideWay&) = default;
};

struct SideWays {
  static constexpr std::size_t most = 3;

  std::vector<SideWay> sides;       ///< empty: a single view; `most` at most
  std::vector<CameraPose> cameras;  ///< one for each of `sides`; empty: all share the first view's camera

  friend bool operator==(const SideWays&, const SideWays&) = default;
};

}  // namespace viete::document
