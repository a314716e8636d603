// The view settings of a document, and the settings of additional views.
#pragma once

#include <vector>

#include "analysis/field.h"
#include "base/choice.h"
#include "document/camera.h"
#include "pose/deformer.h"
#include "sym3/exp.h"

namespace viete::document {

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

enum class Shading { clay, porcelain, jade, file, checker, normals, zebra };

std::span<const Choice> choices(Shading);

struct ViewOptions {
  bool dark = true;
  bool model = true;
  bool deformed = true;             ///< if false, shows the model at rest
  Shading shading = Shading::file;  ///< `file` shows clay if the file has no material
  bool wireframe = false;
  bool cage = true;
  bool grid = true;
  bool axes = true;                               ///< shows the axis widget
  bool ghost = false;                             ///< while the cage is posed, also shows its rest pose
  analysis::Field field = analysis::Field::none;  ///< the map that colours the model
  bool select_visible = false;  ///< if true, the mouse cannot select elements behind the model or the cage
  bool panels = true;
  bool hints = true;  ///< shows hints; false after the first drag

  friend bool operator==(const ViewOptions&, const ViewOptions&) = default;
};

/// The settings of an additional view. The first view has the document's settings.
struct SideView {
  pose::Deformer deformer;
  sym3::Method method = sym3::Method::fast;
  analysis::Field field = analysis::Field::none;
  /// If true, uses the blending that the document does not use: linear instead of log space, or the reverse.
  bool other_blending = false;

  friend bool operator==(const SideView&, const SideView&) = default;
};

struct SideViews {
  static constexpr std::size_t most = 3;

  std::vector<SideView> sides;      ///< the additional views; no more than `most`
  std::vector<CameraPose> cameras;  ///< one for each additional view; if empty, all views share one camera

  friend bool operator==(const SideViews&, const SideViews&) = default;
};

}  // namespace viete::document
