#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <string>

#include "files/recovery.h"
#include "ui/imgui_bridge.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command.h"
#include "workspace/workspace.h"

namespace viete::ui {

ImU32 severity_color(const Context& ui, workspace::Severity severity) {
  const ImU32 colors[] = {ui.colors.text, ui.colors.warn, ui.colors.bad};
  return colors[static_cast<std::size_t>(severity)];
}

std::string message_text(const workspace::Message& message) {
  constexpr const char* words[] = {"", "Warning: ", "Error: "};
  const std::string times = message.times > 1 ? "  (" + std::to_string(message.times) + " times)" : "";
  return words[static_cast<std::size_t>(message.severity)] + message.text + times;
}

void message_log(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  const document::Viewport& v = w.view.camera.viewport;
  bool open = true;
  const ImVec2 size{std::min(560.0f, v.window.x - 32), std::min(360.0f, v.window.y - 80)};
  const Dialog dialog("Messages", {.at = middle_of_view(ui), .size = size}, dialog_flags, &open);
  w.panels.show_messages = open;
  if (!dialog) return;
  const auto& all = w.messages.all();
  ImGui::BeginChild("list", {0, -(ImGui::GetFrameHeight() + 8)});
  if (all.empty()) note(ui, "No messages.");
  for (std::size_t i = all.size(); i-- > 0;) {
    note(ui, message_text(all[i]), severity_color(ui, all[i].severity));
    record(ui, "message/" + std::to_string(all.size() - 1 - i));
    if (ImGui::IsItemClicked()) ImGui::SetClipboardText(all[i].text.c_str());
    hint("Click to copy the message.");
  }
  ImGui::EndChild();
  if (button(ui, "Clear", "clear_messages", "Clear the list of messages.")) w.messages.clear();
  ImGui::SameLine();
  if (button(ui, "Close", "close_messages", "") || key_pressed(workspace::Key::escape))
    w.panels.show_messages = false;
}

namespace {

// Call before an item of this width. If the item fits, puts the item on the current line.
void flow(float width) {
  const float end = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width;
  if (end <= ImGui::GetWindowPos().x + ImGui::GetWindowSize().x - ImGui::GetStyle().WindowPadding.x)
    ImGui::SameLine();
}

float width_of(const std::string& label) {
  return ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
}

const std::vector<workspace::PictureShape>& picture_of(const Context& ui, const files::RecoveryFile& file) {
  auto& pictures = ui.workspace.panels.recovery_pictures;
  const auto [entry, missing] = pictures.try_emplace(file.file);
  if (missing && file.cage) entry->second = workspace::pose_picture(*file.cage, file.posed, file.up);
  return entry->second;
}

}  // namespace

bool recovery_card(const Context& ui, const files::RecoveryFile& file, const std::string& id, float width) {
  const ImVec2 low = ImGui::GetCursorScreenPos(), high{low.x + width, low.y + recovery_card_height};
  const bool restored =
      ImGui::InvisibleButton(id.c_str(), {width, recovery_card_height}) && !ui.workspace.jobs.loading.running;
  if (restored) ui.workspace.jobs.wishes.open({files::OpenRequest::What::recovery, {file.file}});
  record(ui, id);
  card(ui, low, high, false);
  hint("Restore these edits.  Folder: " + file.folder.string());
  draw_picture(ui, {low.x + 2, low.y + 2}, picture_of(ui, file));
  const float left = low.x + workspace::pose_picture_size.x + 10;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddText({left, low.y + 5}, ui.colors.text, shortened(file.name, high.x - left - 6).c_str());
  draw.AddText({left, low.y + 24}, ui.colors.faint,
               (files::when(file.time) + (file.restored ? ", restored" : "")).c_str());
  return restored;
}

namespace {

// One row of cards, newest first, and the number of files without a card.
void recovery_cards(const Context& ui, const std::vector<files::RecoveryFile>& files) {
  constexpr float width = 196;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float room = ImGui::GetContentRegionAvail().x + gap - (files.size() > 1 ? 60 : 0);
  const auto fitting = static_cast<std::size_t>(room / (width + gap));
  const std::size_t cards = std::clamp<std::size_t>(fitting, 1, files.size());
  for (std::size_t i = 0; i < cards; ++i) {
    if (i > 0) ImGui::SameLine();
    recovery_card(ui, files[i], "recovery/" + std::to_string(i), width);
  }
  if (cards == files.size()) return;
  ImGui::SameLine();
  text_in(ui.colors.faint, "+" + std::to_string(files.size() - cards));
}

}  // namespace

float notice_room(const Context& ui) {
  constexpr float tools = 64, least = 180;
  return std::max(least,
                  ui.workspace.view.camera.viewport.size.x - 2 * tools);  // 2, because notices are centered
}

// A row below the menu bar, above the columns and the view.
void notice_bar(const Context& ui) {
  auto& w = ui.workspace;
  if (!w.panels.has_user) return;
  w.panels.notice_height = 0;
  if (!w.recovery.offered || w.recovery.files.empty()) return;
  const float top = w.view.options.panels ? workspace::PanelLayout::menu_height : 0;
  const ImVec2 size(w.view.camera.viewport.window.x, 0);
  ImGui::SetNextWindowSizeConstraints(size, {size.x, FLT_MAX});
  const Window window("Notice", {.at = {0, top}, .pivot = {0, 0}, .rounding = 0}, card_flags);
  ImGui::AlignTextToFramePadding();
  text_in(ui.colors.text, "Recovered edits. Click one to restore it.");
  for (const char* command : {"restore_leftover", "discard_leftovers", "put_off_leftovers"}) {
    flow(width_of(workspace::find_command(command)->brief));
    command_button(ui, command);
  }
  recovery_cards(ui, w.recovery.offers());
  w.panels.notice_height = ImGui::GetWindowSize().y;
}

namespace {

constexpr std::size_t most_toasts = 3;

// Shortens a text of more than six lines in its middle, because the advice is at the end. The message list
// has the whole text.
std::string in_six_lines(const std::string& text, float width) {
  const auto without = [&](std::size_t cut) {
    std::size_t begin = (text.size() - cut) / 2, end = begin + cut;
    while (begin > 0 && (text[begin] & 0xC0) == 0x80) --begin;  // do not cut UTF-8 characters
    while (end < text.size() && (text[end] & 0xC0) == 0x80) ++end;
    return cut == 0 ? text : text.substr(0, begin) + " ... " + text.substr(end);
  };
  const auto fits = [&](std::size_t cut) {
    const float height = ImGui::CalcTextSize(without(cut).c_str(), nullptr, false, width).y;
    return height < 6.5f * ImGui::GetTextLineHeight();
  };
  if (fits(0)) return text;
  std::size_t low = 0, high = text.size();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (fits(middle) ? high : low) = middle;
  }
  return without(high);
}

// Draws a message above `bottom` and moves `bottom` up. Returns true if the user dismisses the message.
bool toast(const Context& ui, const std::string& name, const std::string& text, ImU32 color, bool closes,
           float& bottom) {
  constexpr float widest = 480, padding = 12, gap = 8;
  const float beside = 2 * padding + (closes ? 32 : 0), room = std::min(widest, notice_room(ui)) - beside;
  const std::string shown = in_six_lines(text, room);
  const ImVec2 words = ImGui::CalcTextSize(shown.c_str(), nullptr, false, room);
  const Window window(name.c_str(),
                      {.at = middle_at(ui, bottom),
                       .pivot = {0.5f, 1},
                       .size = {std::ceil(words.x) + beside, words.y + 16},
                       .padding = {padding, 8},
                       .border = 1},
                      passive_flags | ImGuiWindowFlags_NoScrollWithMouse);
  const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  bottom = low.y - gap;
  ImGui::GetWindowDrawList()->AddRectFilled({low.x + 1, low.y + 5}, {low.x + 4, low.y + size.y - 5}, color);
  ImGui::PushTextWrapPos(padding + room + 1);
  text_in(ui.colors.text, shown);
  ImGui::PopTextWrapPos();
  record(ui, name);
  if (ImGui::IsItemClicked()) ui.workspace.panels.show_messages = true;
  hint("Click to see all messages.");
  if (!closes) return false;
  ImGui::SameLine(size.x - 30);
  return button(ui, "x", name + "/close", "Hide this message. Help, Show messages still lists it.");
}

// Indices of the visible messages, newest first.
std::vector<std::size_t> visible_messages(const workspace::Messages& messages) {
  std::vector<std::size_t> newest;
  for (std::size_t i = messages.all().size(); i-- > 0;)
    if (messages.all()[i].visible) newest.push_back(i);
  return newest;
}

}  // namespace

void toasts(const Context& ui, float bottom) {
  workspace::Workspace& w = ui.workspace;
  if (!w.panels.has_user) return;
  const auto newest = visible_messages(w.messages);
  for (std::size_t i = 0; i < std::min(most_toasts, newest.size()); ++i) {
    const workspace::Message& message = w.messages.all()[newest[i]];
    const ImU32 color =
        message.severity == workspace::Severity::info ? ui.colors.good : severity_color(ui, message.severity);
    if (toast(ui, "toast/" + std::to_string(i), message_text(message), color, true, bottom))
      w.messages.dismiss(newest[i]);
  }
  if (newest.size() > most_toasts)
    toast(ui, "toast/more", "and " + std::to_string(newest.size() - most_toasts) + " more", ui.colors.faint,
          false, bottom);
}

namespace {

using workspace::Answer;

constexpr std::array answers = {Answer::save, Answer::cancel, Answer::proceed};
constexpr std::array names = {"question_save", "question_cancel", "question_go_on"};
constexpr float question_width = 440;

// The answer that Enter gives has the accent colour.
bool answer_button(const Context& ui, std::size_t i) {
  const workspace::Question& question = *ui.workspace.files.question;
  const bool chosen = question.chosen == i;
  if (chosen) {
    for (const auto color : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive})
      ImGui::PushStyleColor(color, ui.colors.accent);
    ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.on_axis);
  }
  const bool clicked = button(ui, workspace::label(question.kind, answers[i]), names[i], "");
  if (chosen) ImGui::PopStyleColor(4);
  return clicked;
}

// Draws the buttons of the answers. The button of a destructive answer is at the right end of the row.
std::optional<Answer> answer_row(const Context& ui) {
  std::optional<Answer> answer;
  const float left = ImGui::GetCursorPosX();
  for (std::size_t i = 0; i < answer_count(ui.workspace.files.question->kind); ++i) {
    if (i > 0) ImGui::SameLine();
    if (answers[i] == Answer::proceed)
      ImGui::SetCursorPosX(left + question_width -
                           width_of(workspace::label(ui.workspace.files.question->kind, answers[i])));
    if (answer_button(ui, i)) answer = answers[i];
  }
  return answer;
}

// Enter gives the chosen answer, Tab and the arrows choose another answer, Esc cancels.
std::optional<Answer> answer_by_key(workspace::Question& question) {
  using workspace::Key;
  const bool back = key_pressed(Key::left) || (key_pressed(Key::tab) && ImGui::GetIO().KeyShift);
  const bool forth = key_pressed(Key::right) || (key_pressed(Key::tab) && !ImGui::GetIO().KeyShift);
  const std::size_t count = answer_count(question.kind);
  if (back || forth) question.chosen = (question.chosen + (forth ? 1 : count - 1)) % count;
  if (key_pressed(Key::escape)) return Answer::cancel;
  if (enter_pressed()) return answers[question.chosen];
  return std::nullopt;
}

void question_words(const Context& ui) {
  const workspace::Question& question = *ui.workspace.files.question;
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
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const Dialog dialog("Question", {.at = {0.5f * display.x, 0.42f * display.y}, .padding = {20, 16}},
                      sized_flags | ImGuiWindowFlags_NoNav);
  if (!dialog) return;
  question_words(ui);
  const auto clicked = answer_row(ui), typed = answer_by_key(*ui.workspace.files.question);
  if (const auto answer = clicked ? clicked : typed)
    ui.workspace.jobs.wishes.add(workspace::AnswerQuestion{*answer});
}

namespace {

constexpr double silent_seconds = 0.2;  // shorter work shows no bar

// The remaining time in words; longer times are rounded to larger steps.
std::string words_of(std::optional<double> left) {
  if (!left) return "";
  if (*left < 1) return "a few seconds left";
  if (*left > 90) return std::to_string(std::lround(*left / 60)) + " min left";
  const double step = *left > 10 ? 5 : 1;
  return std::to_string(std::lround(step * std::ceil(*left / step))) + " s left";
}

void row(const Context& ui, const workspace::WorkState& work, const char* stop) {
  constexpr float widest = 420, time_width = 96;
  const float width = std::min(widest, notice_room(ui) - 2 * ImGui::GetStyle().WindowPadding.x);
  const float right = ImGui::GetCursorScreenPos().x + width;
  text_right(ui, right, words_of(base::time_left(work.done, work.seconds)), ui.colors.faint);
  ImGui::TextUnformatted(shortened(work.what, width - time_width).c_str());
  hint(work.what);
  progress_bar(ui, width, work.done);
  command_button(ui, stop);
}

bool shows(const workspace::WorkState& work) {
  return work.running && work.age >= silent_seconds;
}

}  // namespace

float work_bar(const Context& ui, float bottom) {
  auto& w = ui.workspace;
  const workspace::WorkState& work = w.jobs.loading.running       ? w.jobs.loading
                                     : w.jobs.making_cage.running ? w.jobs.making_cage
                                                                  : w.jobs.binding;
  if (!shows(work) && !shows(w.jobs.exporting)) return bottom;
  const Window window("Work", {.at = middle_at(ui, bottom - 16), .pivot = {0.5f, 1}}, card_flags);
  if (shows(w.jobs.exporting)) row(ui, w.jobs.exporting, "stop_export");
  if (shows(w.jobs.exporting) && shows(work)) ImGui::Spacing();
  if (shows(work)) row(ui, work, "stop_work");
  return ImGui::GetWindowPos().y + 28;
}

}  // namespace viete::ui
