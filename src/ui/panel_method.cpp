#include <algorithm>
#include <cmath>
#include <string>

#include "scene/document/edit.h"
#include "scene/workspace/command.h"
#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr const char* command_names[] = {"method_diag", "method_sd", "method_improved_sd", "method_fast"};

constexpr std::size_t none = 99;

// The one method that is better than all others; none at a tie, as at rest, where every answer is exact.
template <class Value>
std::size_t best(const scene::MethodStats& stats, Value value) {
  std::size_t first = 0, equals = 0;
  for (std::size_t i = 1; i < stats.samples.size(); ++i) {
    const double a = value(stats.samples[i]), b = value(stats.samples[first]);
    if (a == b) ++equals;
    if (a < b || std::isnan(b)) first = i, equals = 0;
  }
  return equals == 0 ? first : none;
}

// Which of a method's two figures are better than those of all others.
struct Marks {
  bool time = false, error = false;
};

Marks marks_of(const scene::MethodStats& stats, std::size_t index) {
  return {index == best(stats, [](const scene::MethodSample& s) { return s.ns_per_matrix; }),
          index == best(stats, [](const scene::MethodSample& s) { return s.worst_error; })};
}

// An error that is seen, or adds up to one: from here on the panel points at it.
constexpr double visible_error = 1e-10;

bool fails(const scene::MethodSample& sample) {
  return !(sample.worst_error < visible_error);
}

void card_text(const Context& ui, ImVec2 at, float width, const char* title,
               const scene::MethodSample* sample, bool used, Marks marks, bool active) {
  constexpr float margin = 10, second_line = 25;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 text = used ? ui.colors.text : ui.colors.faint;
  ImGui::PushFont(ui.fonts.strong);
  draw.AddText({at.x + margin, at.y + 6}, text, title);
  ImGui::PopFont();
  if (active && used) draw.AddCircleFilled({at.x + width - 13, at.y + 14}, 4, ui.colors.accent);
  if (!sample) return;
  ImGui::PushFont(ui.fonts.numbers);
  const std::string time = nanoseconds(sample->ns_per_matrix), worst = rough_error(sample->worst_error);
  draw.AddText({at.x + margin, at.y + second_line}, marks.time ? ui.colors.accent : text, time.c_str());
  draw.AddText({at.x + width - margin - ImGui::CalcTextSize(worst.c_str()).x, at.y + second_line},
               fails(*sample) ? ui.colors.warn
               : marks.error  ? ui.colors.accent
                              : ui.colors.faint,
               worst.c_str());
  ImGui::PopFont();
}

// One large toggle: the method's name, its time per matrix and its worst error, in colour what it is best at.
void card(const Context& ui, std::size_t index, float width, bool used) {
  scene::Workspace& w = ui.workspace;
  const scene::Command& command = *scene::find_command(command_names[index]);
  const bool active = w.document.method == scene::compared_methods[index];
  const ImVec2 at = ImGui::GetCursorScreenPos(), size{width, 46};
  if (ImGui::InvisibleButton(command_names[index], size)) command.run(w);
  record(ui, command_names[index], used);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + size.x, at.y + size.y};
  draw.AddRectFilled(at, end,
                     active && used ? ui.colors.card_active
                     : hovered      ? ui.colors.card_hover
                                    : ui.colors.card,
                     6);
  if (active && used) draw.AddRect(at, end, ui.colors.accent, 6, 0, 1.5f);

  const bool measured = running_sample(w) != nullptr;
  const Marks marks = measured ? marks_of(w.methods, index) : Marks{};
  card_text(ui, at, width, command.brief.data(), measured ? &w.methods.samples[index] : nullptr, used, marks,
            active);
  hint(std::string(command.hint) + "  (" + scene::text(w.remembered.keymap.of(command).first) + ")");
}

}  // namespace

void panel_method(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  const bool used = w.document.scheme.exponential();
  heading(ui, "Method");
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  ImGui::BeginDisabled(!used);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
  for (std::size_t i = 0; i < scene::compared_methods.size(); ++i) {
    card(ui, i, width, used);
    if (i % 2 == 0) ImGui::SameLine();
  }
  ImGui::PopStyleVar();
  ImGui::EndDisabled();
  note(ui, !used                                  ? "This deformer takes no exponential."
           : scene::differs_from_rest(w.document) ? "Per matrix; largest error in this pose"
                                                  : "At rest every method is exact.");
  hint("Medians over " + count(w.methods.matrices) +
       " matrices of this frame. Errors are relative, against 106 bits. Colour marks the best, and errors "
       "above 1e-10.");
}

}  // namespace viete::ui
