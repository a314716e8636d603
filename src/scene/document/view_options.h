// What of a document the view shows, and how.
#pragma once

#include "base/choice.h"
#include "lab/field.h"

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
  bool axes = true;             ///< the axis widget
  bool ghost = false;           ///< the rest pose of the cage, faintly, while the cage is posed
  lab::Field field = lab::Field::none;  ///< as colours on the mesh
  bool select_visible = false;  ///< what model or cage hide is not selected with the mouse
  bool same_path = false;       ///< method `fast` runs link by link in double, too, as the others do
  bool panels = true;
  bool help = false;
  bool hints = true;  ///< of the first start; gone after the first drag

  friend bool operator==(const ViewOptions&, const ViewOptions&) = default;
};

}  // namespace viete::scene
