#include <array>
#include <string>

#include "ui/imgui_bridge.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

using scene::Answer;

constexpr std::array answers = {Answer::save, Answer::cancel, Answer::go_on};
constexpr std::array names = {"question_save", "question_cancel", "question_go_on"};
constexpr float question_width = 440;

// The one that Enter gives is filled.
bool answer_button(const Context& ui, std::size_t i) {
  const scene::Question& question = *ui.workspace.question;
  const bool chosen = question.chosen == i;
  if (chosen) {
    for (const auto color : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive})
      ImGui::PushStyleColor(color, ui.colors.accent);
    ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.on_axis);
  }
  const bool clicked = ImGui::Button(scene::label(question.kind, answers[i]));
  if (chosen) ImGui::PopStyleColor(4);
  record(ui, names[i]);
  return clicked;
}

float button_width(const scene::Question& question, Answer answer) {
  return ImGui::CalcTextSize(scene::label(question.kind, answer)).x + 2 * ImGui::GetStyle().FramePadding.x;
}

// What loses something stands apart, at the far end.
std::optional<Answer> answer_row(const Context& ui) {
  std::optional<Answer> answer;
  const float left = ImGui::GetCursorPosX();
  for (std::size_t i = 0; i < answer_count(ui.workspace.question->kind); ++i) {
    if (i > 0) ImGui::SameLine();
    if (answers[i] == Answer::go_on)
      ImGui::SetCursorPosX(left + question_width - button_width(*ui.workspace.question, answers[i]));
    if (answer_button(ui, i)) answer = answers[i];
  }
  return answer;
}

// Enter gives the chosen answer, Tab and the arrows choose another, Esc is Cancel.
std::optional<Answer> answer_by_key(scene::Question& question) {
  using scene::Key;
  const bool back = key_pressed(Key::left) || (key_pressed(Key::tab) && ImGui::GetIO().KeyShift);
  const bool forth = key_pressed(Key::right) || (key_pressed(Key::tab) && !ImGui::GetIO().KeyShift);
  const std::size_t count = answer_count(question.kind);
  if (back || forth) question.chosen = (question.chosen + (forth ? 1 : count - 1)) % count;
  if (key_pressed(Key::escape)) return Answer::cancel;
  if (key_pressed(Key::enter) || key_pressed(Key::pad_enter)) return answers[question.chosen];
  return std::nullopt;
}

void question_words(const Context& ui) {
  const scene::Question& question = *ui.workspace.question;
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + question_width);
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(question.title.c_str());
  ImGui::PopFont();
  ImGui::Spacing();
  ImGui::TextUnformatted(question.text.c_str());
  if (!question.why.empty()) text_in(ui.colors.faint, question.why);
  ImGui::PopTextWrapPos();
  ImGui::Dummy({question_width, 8});
}

}  // namespace

void question_panel(const Context& ui) {
  auto& question = ui.workspace.question;
  if (!question) return;
  ImGui::OpenPopup("Question");
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * display.x, 0.42f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {20, 16});
  constexpr auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;
  if (ImGui::BeginPopupModal("Question", nullptr, flags)) {
    question_words(ui);
    const auto clicked = answer_row(ui), typed = answer_by_key(*question);
    ui.workspace.requests.answer = clicked ? clicked : typed;
    if (ui.workspace.requests.answer) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
}

}  // namespace viete::ui
