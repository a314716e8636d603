#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "scene/binding_plan.h"
#include "scene/edit.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

// What the slider offers: below 2 a model shows the edges of a coarse cage. A session may have others.
constexpr std::array reaches = {2.0, 2.5, 3.0, 4.0, 6.0, 10.0, deform::whole_cage};

void choice(const Context& ui, const char* label, const char* name, deform::Coordinates value,
            const char* tip) {
  auto& document = ui.workspace.document;
  if (ImGui::RadioButton(label, document.coordinates == value)) scene::set_coordinates(document, value);
  record(ui, name);
  const bool bound = document.coordinates == value;
  const std::string cost = document.has_cage() && !bound
                               ? "\n\n" + scene::text(scene::binding_plan(document, value)) + " of memory."
                               : "";
  hint(tip + cost);
}

int nearest_stop(double reach) {
  const auto above = std::lower_bound(reaches.begin(), reaches.end(), reach);
  const bool down =
      above != reaches.begin() && *above > reach && std::log(*above / reach) > std::log(reach / above[-1]);
  return static_cast<int>(above - reaches.begin()) - (down ? 1 : 0);
}

void reach_slider(const Context& ui) {
  auto& document = ui.workspace.document;
  const bool used = document.coordinates == deform::Coordinates::face;
  ImGui::BeginDisabled(!used);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Reach");
  ImGui::SameLine();
  constexpr float value_width = 84;
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  ImGui::SetNextItemWidth(-value_width);
  int stop = nearest_stop(used ? document.reach : deform::whole_cage);
  const bool moved = ImGui::SliderInt("##reach", &stop, 0, static_cast<int>(reaches.size()) - 1, "",
                                      ImGuiSliderFlags_NoInput);
  if (moved) scene::set_reach(document, reaches[static_cast<std::size_t>(stop)]);
  record(ui, "reach", used);
  ImGui::EndDisabled();
  hint(used ? "How far each face of the cage reaches. At 3, a part of the model follows the faces that are "
              "at most 3 "
              "times as far away as the nearest ones, and no others: edits stay where they are made. The "
              "whole cage: "
              "every face moves all of the model, if only a little."
            : "Mean value coordinates have no reach: every vertex of the cage moves all of the model. Choose "
              "Faces "
              "first.");
  ImGui::SameLine();
  const bool all = !used || !(document.reach < deform::whole_cage);
  const std::string text = all ? "whole cage" : deform::text_of_reach(document.reach) + " x nearest";
  ImGui::SetCursorScreenPos({right - ImGui::CalcTextSize(text.c_str()).x, ImGui::GetCursorScreenPos().y});
  ImGui::AlignTextToFramePadding();
  ImGui::BeginDisabled(!used);
  ImGui::TextUnformatted(text.c_str());
  ImGui::EndDisabled();
}

}  // namespace

void coordinates_choice(const Context& ui) {
  choice(ui, "Faces, log space", "coordinates_face", deform::Coordinates::face,
         "Each cage triangle carries an affine map; maps are blended in log space with weights 1/d^2. Bends "
         "and twists "
         "keep volume.");
  ImGui::SameLine(0.55f * column_width);
  choice(
      ui, "Mean value", "coordinates_mvc", deform::Coordinates::mean_value,
      "Positions of cage vertices are blended with mean value coordinates. Smooth, linear, no exponential.");
  reach_slider(ui);
}

}  // namespace viete::ui
