#include <string>

#include "scene/binding_plan.h"
#include "scene/edit.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

void choice(const Context& ui, const char* label, const char* name, deform::Coordinates value, const char* tip) {
  auto& document = ui.workspace.document;
  if (ImGui::RadioButton(label, document.coordinates == value)) scene::set_coordinates(document, value);
  record(ui, name);
  const bool bound = document.coordinates == value;
  const std::string cost =
      document.has_cage() && !bound ? "\n\n" + scene::text(scene::binding_plan(document, value)) + " of memory." : "";
  hint(tip + cost);
}

}  // namespace

void coordinates_choice(const Context& ui) {
  choice(ui, "Faces, log space", "coordinates_face", deform::Coordinates::face,
         "Each cage triangle carries an affine map; maps are blended in log space with weights 1/d^2. Bends and twists "
         "keep volume.");
  ImGui::SameLine(0.55f * column_width);
  choice(ui, "Mean value", "coordinates_mvc", deform::Coordinates::mean_value,
         "Positions of cage vertices are blended with mean value coordinates. Smooth, linear, no exponential.");
}

}  // namespace viete::ui
