#include <cmath>
#include <string>

#include "scene/binding_plan.h"
#include "scene/commands.h"
#include "scene/edit.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

void scheme_button(const Context& ui, const scene::Combination& combination) {
  scene::Workspace& w = ui.workspace;
  const scene::Command& command = *scene::find_command(combination.name);
  const bool chosen = w.document.scheme == combination;
  if (ImGui::RadioButton(command.label.data(), chosen)) command.run(w);
  record(ui, command.name.data());
  std::string tip(command.hint);
  const bool bound = combination.elements == w.document.scheme.weighting.elements &&
                     combination.weights == w.document.scheme.weighting.weights;
  if (w.document.has_cage() && !bound)
    tip += "\n\n" + scene::text(scene::binding_plan(w.document, combination.elements)) + " of memory.";
  hint(tip);
}

void reach_slider(const Context& ui) {
  scene::Document& document = ui.workspace.document;
  const scene::Condition& condition = scene::find_command("reach_longer")->enabled;
  const bool used = condition(ui.workspace);
  const auto reaches = scene::usual_reaches();
  const double reach = used ? document.scheme.weighting.reach : scene::whole_cage;
  ImGui::BeginDisabled(!used);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Reach");
  ImGui::SameLine();
  constexpr float value_width = 84;
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  ImGui::SetNextItemWidth(-value_width);
  int stop = static_cast<int>(scene::nearest_reach(reach));
  const bool moved = ImGui::SliderInt("##reach", &stop, 0, static_cast<int>(reaches.size()) - 1, "",
                                      ImGuiSliderFlags_NoInput);
  if (moved) scene::set_reach(document, reaches[static_cast<std::size_t>(stop)]);
  record(ui, "reach", used);
  ImGui::EndDisabled();
  hint(used ? "How far each face of the cage reaches. At 3, a part of the model follows the faces that are "
              "at most 3 times as far away as the nearest ones, and no others: edits stay where they are "
              "made. The whole cage: every face moves all of the model, if only a little."
            : std::string(condition.otherwise));
  ImGui::SameLine();
  const bool all = !(reach < scene::whole_cage);
  const std::string text = all ? "whole cage" : scene::text_of_reach(reach) + " x nearest";
  ImGui::SetCursorScreenPos({right - ImGui::CalcTextSize(text.c_str()).x, ImGui::GetCursorScreenPos().y});
  ImGui::AlignTextToFramePadding();
  ImGui::BeginDisabled(!used);
  ImGui::TextUnformatted(text.c_str());
  ImGui::EndDisabled();
}

}  // namespace

void blending(const Context& ui) {
  std::size_t place = 0;
  for (const scene::Combination& combination : scene::combinations()) {
    if (place++ % 2 == 1) ImGui::SameLine(0.55f * column_width);
    scheme_button(ui, combination);
  }
  reach_slider(ui);
}

}  // namespace viete::ui
