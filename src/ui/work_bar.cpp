#include <algorithm>
#include <cmath>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr double silent_seconds = 0.2;  // what is done sooner shows no bar

// No more exactly than it is known.
std::string words_of(std::optional<double> left) {
  if (!left) return "";
  if (*left < 1) return "a moment";
  if (*left > 90) return std::to_string(std::lround(*left / 60)) + " min left";
  const double step = *left > 10 ? 5 : 1;
  return std::to_string(std::lround(step * std::ceil(*left / step))) + " s left";
}

// What is done, how far, and a way to stop it.
void row(const Context& ui, const scene::WorkState& work, scene::TimeLeft& time_left, const char* stop) {
  constexpr float widest = 420, time_width = 96;
  const float width = std::min(widest, notice_room(ui) - 2 * ImGui::GetStyle().WindowPadding.x);
  const float right = ImGui::GetCursorScreenPos().x + width;
  text_right(ui, right, words_of(time_left.of(work)), ui.colors.faint);
  ImGui::TextUnformatted(shortened(work.what, width - time_width).c_str());
  hint(work.what);
  progress_bar(ui, width, work.done);
  command_button(ui, stop);
}

bool shows(const scene::WorkState& work) {
  return work.running && work.age >= silent_seconds;
}

}  // namespace

float work_bar(const Context& ui, float bottom) {
  auto& w = ui.workspace;
  const scene::WorkState& work = w.loading.running       ? w.loading
                                 : w.making_cage.running ? w.making_cage
                                                         : w.binding;
  if (!shows(work) && !shows(w.exporting)) return bottom;
  const Window window("Work", {.at = middle_at(ui, bottom - 16), .pivot = {0.5f, 1}}, card_flags);
  if (shows(w.exporting)) row(ui, w.exporting, w.export_left, "stop_export");
  if (shows(w.exporting) && shows(work)) ImGui::Spacing();
  if (shows(work)) row(ui, work, w.time_left, "stop_work");
  return ImGui::GetWindowPos().y + 28;
}

}  // namespace viete::ui
