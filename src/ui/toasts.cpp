// At the bottom of the view: messages of the last seconds, in two lines each. Nothing else moves for them.
#include <algorithm>

#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float widest_toast = 480, toast_padding = 12, toast_gap = 8, close_width = 28, mark_width = 3;
constexpr std::size_t most_toasts = 3;

struct Toast {
  std::string name, text;
  ImU32 color;
  bool closes = true;
};

enum class Pressed { nothing, text, close };

void cross(ImDrawList& draw, ImVec2 middle, ImU32 color) {
  constexpr float r = 4;
  draw.AddLine({middle.x - r, middle.y - r}, {middle.x + r, middle.y + r}, color, 1.5f);
  draw.AddLine({middle.x - r, middle.y + r}, {middle.x + r, middle.y - r}, color, 1.5f);
}

// Shortened to two lines; the list of messages has the whole text.
std::string in_two_lines(const std::string& text, float width) {
  const auto fits = [&](const std::string& part) {
    return ImGui::CalcTextSize(part.c_str(), nullptr, false, width).y < 2.5f * ImGui::GetTextLineHeight();
  };
  if (fits(text)) return text;
  std::size_t low = 0, high = text.size();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (fits(text.substr(0, middle) + "...") ? low : high) = middle;
  }
  const std::size_t space = text.rfind(' ', low);
  if (space != std::string::npos && space > low / 2) low = space;
  while (low > 0 && (text[low] & 0xC0) == 0x80) --low;  // within a letter
  return text.substr(0, low) + "...";
}

// Ends above `bottom`, which it moves up.
Pressed draw_toast(const Context& ui, const Toast& toast, float& bottom) {
  const scene::Viewport& v = ui.workspace.viewport;
  const float beside = mark_width + 2 * toast_padding + (toast.closes ? close_width : 0);
  const float room = std::min(widest_toast, notice_room(ui)) - beside;
  const std::string shown = in_two_lines(toast.text, room);
  const ImVec2 text = ImGui::CalcTextSize(shown.c_str(), nullptr, false, room);
  const ImVec2 size{text.x + beside, text.y + 16};
  const ImVec2 low{std::floor(v.origin.x + 0.5f * (v.size.x - size.x)), bottom - size.y};
  bottom = low.y - toast_gap;
  ImGui::SetNextWindowPos(low);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin(toast.name.c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoNav);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 high{low.x + size.x, low.y + size.y};
  draw.AddRectFilled(low, high, ui.colors.card, 6);
  draw.AddRect(low, high, ui.colors.line, 6);
  draw.AddRectFilled({low.x, low.y + 4}, {low.x + mark_width, high.y - 4}, toast.color, 1.5f);
  Pressed pressed = Pressed::nothing;
  if (ImGui::InvisibleButton("text", {size.x - (toast.closes ? close_width : 0), size.y}))
    pressed = Pressed::text;
  record(ui, toast.name);
  if (toast.closes) hint("Click to see all messages.");
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {low.x + mark_width + toast_padding, low.y + 8},
               ui.colors.text, shown.c_str(), nullptr, room + 1);
  if (toast.closes) {
    ImGui::SameLine(0, 0);
    if (ImGui::InvisibleButton("close", {close_width, size.y})) pressed = Pressed::close;
    record(ui, toast.name + "/close");
    cross(draw, {high.x - 0.5f * close_width - 2, 0.5f * (low.y + high.y)},
          ImGui::IsItemHovered() ? ui.colors.text : ui.colors.faint);
    hint("Put it away; it stays in the list of messages.");
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  return pressed;
}

// Newest lowest.
std::vector<std::size_t> in_sight(const scene::Messages& messages) {
  std::vector<std::size_t> newest;
  for (std::size_t i = messages.all().size(); i-- > 0;) {
    if (messages.all()[i].in_sight) newest.push_back(i);
  }
  return newest;
}

}  // namespace

void toasts(const Context& ui, float bottom) {
  scene::Workspace& w = ui.workspace;
  if (!w.attended) return;
  const auto newest = in_sight(w.messages);
  for (std::size_t i = 0; i < std::min(most_toasts, newest.size()); ++i) {
    const scene::Message& message = w.messages.all()[newest[i]];
    const Toast toast{
        "toast/" + std::to_string(i), message_text(message),
        message.severity == scene::Severity::info ? ui.colors.good : severity_color(ui, message.severity)};
    const Pressed pressed = draw_toast(ui, toast, bottom);
    if (pressed == Pressed::text) w.show_messages = true;
    if (pressed == Pressed::close) w.messages.dismiss(newest[i]);
  }
  if (newest.size() <= most_toasts) return;
  const std::string more = "and " + std::to_string(newest.size() - most_toasts) + " more";
  if (draw_toast(ui, {"toast/more", more, ui.colors.faint, false}, bottom) == Pressed::text)
    w.show_messages = true;
}

}  // namespace viete::ui
