#include <algorithm>

#include "base/text.h"
#include "document/elements.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/workspace.h"

namespace viete::ui {

namespace {

constexpr std::size_t named = 6;  // elements listed in a card
constexpr float inset = 10;

std::size_t mattering(const workspace::CheckState& checks) {
  return static_cast<std::size_t>(std::ranges::count_if(checks.findings, document::matters));
}

float wrapped_height(const std::string& text, float width) {
  return ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y;
}

// Draws title, explanation and first elements of a finding. A click shows the elements in the view.
void finding_card(const Context& ui, std::size_t index) {
  auto& checks = ui.workspace.checks;
  const document::Finding& finding = checks.findings[index];
  const bool shown = checks.shown == index;
  const float width = ImGui::GetContentRegionAvail().x, wrap = width - 2 * inset;
  const std::string means = wrapped(document::meaning(finding), wrap);
  const std::string elements =
      document::element_name(finding.kind) + ' ' + document::first_elements(finding, named);
  const std::string title = document::title(finding);
  ImGui::PushFont(ui.fonts.strong);
  const float top = wrapped_height(title, wrap) + ImGui::GetStyle().ItemSpacing.y;
  ImGui::PopFont();
  const float middle = wrapped_height(means, wrap);
  ImGui::PushFont(ui.fonts.numbers);
  const float bottom = wrapped_height(elements, wrap);
  ImGui::PopFont();

  const ImVec2 at = ImGui::GetCursorScreenPos(), size{width, 7 + top + middle + 4 + bottom + 8};
  const std::string name = "finding/" + std::to_string(index);
  const bool clicked = ImGui::InvisibleButton(name.c_str(), size);
  record(ui, name);
  card(ui, at, {at.x + size.x, at.y + size.y}, shown);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float x = at.x + inset;
  float y = at.y + 7;
  const ImU32 color = document::matters(finding) ? ui.colors.warn : ui.colors.text;
  ImGui::PushFont(ui.fonts.strong);
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x, y}, color, title.c_str(), nullptr, wrap);
  ImGui::PopFont();
  y += top;
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x, y}, ui.colors.faint, means.c_str(), nullptr, wrap);
  y += middle + 4;
  ImGui::PushFont(ui.fonts.numbers);
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x, y}, ui.colors.text, elements.c_str(), nullptr,
               wrap);
  ImGui::PopFont();
  hint(shown ? "Click to hide the elements." : "Click to show the elements in the view.");
  if (clicked) workspace::toggle_finding(ui.workspace, index);
}

// Buttons to step through the elements: "< 3 of 17 >".
void stepper(const Context& ui) {
  auto& checks = ui.workspace.checks;
  const document::Finding& finding = checks.findings[*checks.shown];
  if (finding.size() < 2) return;
  const float wide = 34, width = ImGui::GetContentRegionAvail().x;
  const float left = ImGui::GetCursorPosX();
  const auto step = [&](const char* label, const char* name, int by, const char* tip) {
    if (button(ui, label, name, tip, {wide, 0})) workspace::step_element(ui.workspace, by);
  };
  step("<##finding", "finding_previous", -1, "Show only the previous element.");
  const std::string text = checks.element ? count(*checks.element + 1) + " of " + count(finding.size())
                                          : "all " + count(finding.size());
  ImGui::SameLine(left + 0.5f * (width - ImGui::CalcTextSize(text.c_str()).x));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text.c_str());
  ImGui::SameLine(left + width - wide);
  step(">##finding", "finding_next", 1, "Show only the next element.");
}

// Buttons to fit a cage that does not enclose the model.
void fit_buttons(const Context& ui) {
  if (ui.workspace.document.kept_pose()) {  // panel_cage() shows the buttons Enclose and Fit
    note(ui, "Enclose moves the cage outward there.");
    return command_row(ui, {"show_outside"});
  }
  note(ui, "Enclose moves the cage outward there; Fit moves and scales the whole cage.");
  command_row(ui, {"show_outside", "enclose_model", "fit_cage"});
}

// Lists the findings of the cage or of the model.
void group(const Context& ui, document::Subject subject, const char* heading) {
  const auto& checks = ui.workspace.checks;
  bool first = true;
  for (std::size_t i = 0; i < checks.findings.size(); ++i) {
    if (checks.findings[i].subject != subject) continue;
    if (first) note(ui, heading);
    first = false;
    finding_card(ui, i);
    if (checks.shown == i) stepper(ui);
    if (i == workspace::outside_finding(checks)) fit_buttons(ui);
  }
}

}  // namespace

std::string checks_summary(const workspace::CheckState& checks, std::size_t of_pose) {
  if (checks.running) return "checking " + std::to_string(static_cast<int>(100 * checks.done)) + " %";
  const std::size_t problems = mattering(checks) + of_pose,
                    notes = checks.findings.size() - mattering(checks);
  const std::string text = problems > 0 ? base::counted(problems, "problem") : "";
  if (notes == 0) return problems > 0 ? text : "no problems";
  return text + (problems > 0 ? ", " : "") + base::counted(notes, "note");
}

void panel_checks(const Context& ui) {
  auto& checks = ui.workspace.checks;
  if (!ui.workspace.document.model().surface) return;
  const std::size_t matter = checks.running ? 0 : mattering(checks);
  if (checks.fresh) ui.workspace.preferences.layout.sections["Checks"] = matter > 0;
  checks.fresh = false;
  const bool open = section(ui, "Checks", false);
  const auto& of_pose = ui.workspace.frame.notes;
  section_note(ui, checks_summary(checks, of_pose.size()), matter + of_pose.size() > 0 ? ui.colors.warn : 0);
  if (!open) return;
  for (std::size_t i = 0; i < of_pose.size(); ++i) {
    note(ui, of_pose[i], ui.colors.warn);
    record(ui, "pose_note/" + std::to_string(i));
  }
  if (checks.running) return note(ui, "Checking model and cage.");
  if (checks.findings.empty())
    note(ui, ui.workspace.document.has_cage() ? "Model and cage are closed, oriented manifolds. The cage "
                                                "encloses the model without self-intersections."
                                              : "The model is a closed, oriented manifold.");
  group(ui, document::Subject::cage, "Cage");
  group(ui, document::Subject::model, "Model");
}

}  // namespace viete::ui
