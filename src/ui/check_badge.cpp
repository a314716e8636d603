// At the bottom of the view: what is wrong with cage or model, and the one thing that helps, for who does not
// see the section of the checks.
#include "scene/workspace/check_view.h"
#include "scene/workspace/command.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

bool shows_badge(const scene::Workspace& w) {
  return w.checks.badge && w.attended && w.view.panels && !w.view.help && !w.browser.open && !w.question &&
         !w.making.open && !w.loading.running && !w.interaction.drag && !offers_next_step(w);
}

// Where it is, or away with it again. While it is looked for anew it cannot be shown.
void show_button(const Context& ui, const scene::CheckBadge& badge) {
  const auto at = scene::find_finding(ui.workspace.checks, badge.kind);
  ImGui::BeginDisabled(!at);
  const bool shown = at && ui.workspace.checks.shown == at;
  if (ImGui::Button(shown ? "Hide##badge" : "Show##badge")) scene::toggle_finding(ui.workspace, *at);
  ImGui::EndDisabled();
  record(ui, "badge/show", at.has_value());
  hint("Where they are in the view; the section Checks steps through them.");
}

void helping_button(const Context& ui, const scene::Command& command) {
  const bool enabled = command.enabled(ui.workspace);
  ImGui::BeginDisabled(!enabled);
  if (ImGui::Button((std::string(command.label) + "##badge").c_str())) command.run(ui.workspace);
  ImGui::EndDisabled();
  record(ui, "badge/" + std::string(command.name), enabled);
  hint(hint_of(ui, command));
}

}  // namespace

float check_badge(const Context& ui, float bottom) {
  scene::Workspace& w = ui.workspace;
  if (!shows_badge(w)) return bottom;
  const scene::CheckBadge badge = *w.checks.badge;
  const Window window("Check badge",
                      {.at = middle_at(ui, bottom), .pivot = {0.5f, 1}, .rounding = 6, .padding = {10, 5}},
                      card_flags);
  ImGui::AlignTextToFramePadding();
  text_in(ui.colors.warn, badge.title);
  record(ui, "badge");
  ImGui::SameLine();
  const std::string_view helps = scene::remedy(badge);
  if (helps.empty()) {
    show_button(ui, badge);
  } else {
    helping_button(ui, *scene::find_command(helps));
  }
  ImGui::SameLine(0, 2);
  ImGui::PushStyleColor(ImGuiCol_Button, 0);
  if (ImGui::Button("x##badge")) scene::put_badge_away(w.checks);
  ImGui::PopStyleColor();
  record(ui, "badge/close");
  hint("Put it away; the section Checks still has it.");
  return ImGui::GetWindowPos().y - 8;
}

}  // namespace viete::ui
