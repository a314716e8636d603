// What comes next with a model that was just opened, at the bottom of the view, and never more than one
// thing: a cage, while it has none; what of it is outside of its cage.
#include <algorithm>

#include "scene/document/cage_making.h"
#include "scene/workspace/check_view.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

bool is_free(const scene::Workspace& w) {
  return w.offer_cage && w.document.model.surface && !w.making.open && !w.loading.running &&
         !w.browser.open && !w.question && w.view.panels && !w.view.help;
}

// The finding, until work on the pose has begun.
const scene::Finding* outside(const scene::Workspace& w) {
  const bool begun = w.document.history.can_undo() || w.document.kept_pose || w.interaction.drag;
  if (!w.document.has_cage() || begun || w.checks.running) return nullptr;
  const auto at = scene::outside_finding(w.checks);
  return at ? &w.checks.findings[*at] : nullptr;
}

// Returns how wide it is.
float words(const Context& ui, const std::string& title, const std::string& what) {
  ImGui::PushFont(ui.fonts.strong);
  const float wide = ImGui::CalcTextSize(title.c_str()).x;
  text_in(ui.colors.text, title);
  ImGui::PopFont();
  text_in(ui.colors.faint, what);
  const float width = std::max({320.0f, wide, ImGui::CalcTextSize(what.c_str()).x});
  ImGui::Dummy({width, 2});
  return width;
}

void ways_to_a_cage(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  const float width =
      words(ui, "This model has no cage yet", "A cage is the coarse mesh around it that you drag.");
  if (!w.document.cage_beside.empty()) {
    text_in(ui.colors.text, w.document.cage_beside.filename().string() + " lies beside it.");
    command_button(ui, "open_cage_beside", width);
  }
  command_button(ui, "make_cage", width);
  command_row(ui, {"open_cage", "hide_cage_offer"});
}

void ways_around_it(const Context& ui, const scene::Finding& finding) {
  words(ui, scene::title(finding),
        finding.turned ? "The cage should be around all of it; turned, it fits clearly better."
                       : "The cage should be around all of it.");
  if (finding.turned) command_row(ui, {"fit_cage", "fit_cage_turned"});
  command_row(ui, {"show_outside", "enclose_model", "hide_cage_offer"});
}

}  // namespace

bool offers_next_step(const scene::Workspace& w) {
  return is_free(w) && (!w.document.is_movable() || outside(w));
}

float cage_offer(const Context& ui, float bottom) {
  const scene::Workspace& w = ui.workspace;
  if (!offers_next_step(w)) return bottom;
  const Window window(
      "Cage offer", {.at = middle_at(ui, bottom - 28), .pivot = {0.5f, 1}, .padding = {16, 14}}, card_flags);
  if (const scene::Finding* finding = outside(w)) {
    ways_around_it(ui, *finding);
  } else {
    ways_to_a_cage(ui);
  }
  return ImGui::GetWindowPos().y + 28;
}

}  // namespace viete::ui
