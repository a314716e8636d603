#include "ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "document/edit.h"
#include "interact/number_entry.h"
#include "ui/imgui_bridge.h"

namespace viete::ui {

namespace {

const workspace::Command& require(std::string_view name) {
  const workspace::Command* command = workspace::find_command(name);
  IM_ASSERT(command && "no such command");
  return *command;
}

// Prints as many digits as fit into `room`, from 5 down to 2. If even 2 digits do not fit, prints 5 digits.
std::string printed(double value, float room) {
  for (int digits = 5; digits > 1; --digits) {
    const std::string text = base::formatted(("%." + std::to_string(digits) + "g").c_str(), value);
    if (ImGui::CalcTextSize(text.c_str()).x <= room) return text;
  }
  return base::formatted("%.5g", value);
}

int filter_number(ImGuiInputTextCallbackData* data) {
  if (data->EventChar == ',') data->EventChar = '.';
  const bool known =
      data->EventChar < 128 && std::strchr("+-.eE0123456789", static_cast<int>(data->EventChar));
  return known ? 0 : 1;
}

// The text of a field in the last frame. Some versions of ImGui lose this text when the focus changes.
std::string typed_so_far(const Context& ui, const std::string& name, const std::string& otherwise) {
  const auto typed = ui.workspace.panels.typed.find(name);
  if (typed == ui.workspace.panels.typed.end()) return otherwise;
  const bool still_there = typed->second.frame + 1 == ImGui::GetFrameCount();
  return still_there ? typed->second.text : otherwise;
}

// A text field. Returns the text when the field loses the focus after an edit; nullopt during editing and
// after Esc.
std::optional<std::string> text_field(const Context& ui, const std::string& name, const std::string& shown,
                                      const char* tip, bool enabled = true,
                                      ImGuiInputTextCallback filter = nullptr) {
  char text[200] = "";
  typed_so_far(ui, name, shown).copy(text, sizeof text - 1);
  const int filters = filter ? ImGuiInputTextFlags_CallbackCharFilter : 0;
  ImGui::InputText(("##" + name).c_str(), text, sizeof text, filters | ImGuiInputTextFlags_AutoSelectAll,
                   filter);
  record(ui, name, enabled);
  if (*tip) hint(tip);
  if (ImGui::IsItemActive()) {
    ui.workspace.panels.typed[name] = {text, ImGui::GetFrameCount()};
    return std::nullopt;
  }
  ui.workspace.panels.typed.erase(name);
  return ImGui::IsItemDeactivatedAfterEdit() ? std::optional<std::string>(text) : std::nullopt;
}

constexpr int placed_styles = 4;  // popped after Begin(): menus and tooltips have the usual style

// Returns the nearest place at which a window of this size is inside the screen. A size of 0 is unknown.
Window::Place on_screen(Window::Place place) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const auto inside = [](float at, float pivot, float size, float most) {
    return std::clamp(at, pivot * size, std::max(pivot * size, most - (1 - pivot) * size));
  };
  place.at = {inside(place.at.x, place.pivot.x, place.size.x, screen.x),
              inside(place.at.y, place.pivot.y, place.size.y, screen.y)};
  return place;
}

// Sets the place and the style of the next window.
void place_next(const Window::Place& place) {
  ImGui::SetNextWindowPos(place.at, ImGuiCond_Always, place.pivot);
  if (place.size.x > 0) ImGui::SetNextWindowSize(place.size);
  const ImVec2 padding = place.padding.x < 0 ? ImGui::GetStyle().WindowPadding : place.padding;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, place.rounding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, place.border);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
}

}  // namespace

Window::Window(const char* name, const Place& place, ImGuiWindowFlags flags) {
  place_next(place);
  ImGui::Begin(name, nullptr, flags);
  ImGui::PopStyleVar(placed_styles);
}

Window::~Window() {
  ImGui::End();
}

Dialog::Dialog(const char* name, const Window::Place& place, ImGuiWindowFlags flags, bool* open) {
  place_next(on_screen(place));
  if (!ImGui::IsPopupOpen(name)) ImGui::OpenPopup(name);
  shown_ = ImGui::BeginPopupModal(name, open, flags);
  ImGui::PopStyleVar(placed_styles);
}

Dialog::~Dialog() {
  if (shown_) ImGui::EndPopup();
}

void close_unused_dialog() {
  const auto& open = GImGui->OpenPopupStack;
  const ImGuiWindow* lowest = open.empty() ? nullptr : open[0].Window;
  if (lowest && (lowest->Flags & ImGuiWindowFlags_Modal) && !lowest->Active)
    ImGui::ClosePopupToLevel(0, true);
}

bool is_popup_open() {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

ImVec2 middle_at(const Context& ui, float y) {
  const document::Viewport& v = ui.workspace.view.camera.viewport;
  return {v.origin.x + 0.5f * v.size.x, y};
}

ImVec2 middle_of_view(const Context& ui) {
  const document::Viewport& v = ui.workspace.view.camera.viewport;
  return middle_at(ui, v.origin.y + 0.5f * v.size.y);
}

void text_in(ImU32 color, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void row_label(const char* text, float distance) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  ImGui::SameLine(distance);
}

void value_beside(float right, const std::string& value) {
  ImGui::SameLine();
  ImGui::SetCursorScreenPos({right - ImGui::CalcTextSize(value.c_str()).x, ImGui::GetCursorScreenPos().y});
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(value.c_str());
}

void progress_bar(const Context& ui, float width, double done) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float full = width * static_cast<float>(std::clamp(done, 0.02, 1.0));
  draw.AddRectFilled(at, {at.x + width, at.y + 6}, ui.colors.card_active, 3);
  draw.AddRectFilled(at, {at.x + full, at.y + 6}, ui.colors.accent, 3);
  ImGui::Dummy({width, 8});
}

void search_field(const Context& ui, const char* name, std::string& typed, bool& appearing) {
  char text[256] = "";
  typed.copy(text, sizeof text - 1);
  if (std::exchange(appearing, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##typed", "Find command", text, sizeof text);
  appearing = ImGui::IsItemDeactivated() && enter_pressed();  // Enter does not end typing
  record(ui, name);
  typed = text;
}

std::string hint_of(const Context& ui, const workspace::Command& command) {
  const std::string keys = workspace::text(ui.workspace.preferences.keymap.of(command).first);
  const std::string does =
      command.subject ? command.label_now(ui.workspace) + ".  " + command.hint : command.hint;
  const std::string what = does + (keys.empty() ? "" : "  (" + keys + ")");
  return command.enabled(ui.workspace) ? what : what + "\n" + std::string(command.enabled.otherwise);
}

void record(const Context& ui, const std::string& name, bool enabled) {
  if (!ui.recorder) return;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ui.recorder->add(name, {low.x, low.y, high.x, high.y, ImGui::IsItemVisible(), enabled});
}

bool button(const Context& ui, const char* label, const std::string& name, const std::string& tip,
            ImVec2 size, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  const bool clicked = ImGui::Button(label, size);
  record(ui, name, enabled);
  ImGui::EndDisabled();
  if (!tip.empty()) hint(tip);
  return clicked;
}

void checkbox(const Context& ui, const char* label, const std::string& name, bool& on, const char* tip) {
  ImGui::Checkbox(label, &on);
  record(ui, name);
  hint(tip);
}

bool begin_list(const Context& ui, const std::string& name, const char* shown, const std::string& tip) {
  const bool open = ImGui::BeginCombo(("##" + name).c_str(), shown, ImGuiComboFlags_HeightLargest);
  record(ui, name);
  if (!open && !tip.empty()) hint(tip);
  if (!open) return false;
  workspace::OpenList& list = ui.workspace.panels.open_list;
  if (ImGui::IsWindowAppearing()) list = {};
  const int steps = arrow_steps(), last = std::exchange(list.added, 0) - 1;
  list.moved = steps != 0 && last >= 0;
  if (list.moved) list.entry = std::clamp(list.entry.value_or(-1) + steps, 0, last);
  return true;
}

bool list_entry(const Context& ui, std::string_view label, const std::string& name, bool chosen,
                std::string_view tip) {
  workspace::OpenList& list = ui.workspace.panels.open_list;
  const int index = list.added++;
  if (chosen && !list.entry) list.entry = index;
  const bool marked = list.entry == index, entered = marked && enter_pressed();
  const bool clicked = ImGui::Selectable(std::string(label).c_str(), marked);
  if (marked && list.moved) ImGui::SetScrollHereY();
  if (entered) ImGui::CloseCurrentPopup();
  record(ui, name);
  if (!tip.empty()) hint(std::string(tip));
  return clicked || entered;
}

void card(const Context& ui, ImVec2 low, ImVec2 high, bool active) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 color = active                   ? ui.colors.card_active
                      : ImGui::IsItemHovered() ? ui.colors.card_hover
                                               : ui.colors.card;
  draw.AddRectFilled(low, high, color, 6);
  if (active) draw.AddRect(low, high, ui.colors.accent, 6, 0, 1.5f);
}

bool section(const Context& ui, const char* title, bool open_at_first) {
  auto& sections = ui.workspace.preferences.layout.sections;
  const auto known = sections.find(title);
  const bool was_open = known == sections.end() ? open_at_first : known->second;
  ImGui::SetNextItemOpen(was_open);
  ImGui::PushFont(ui.fonts.strong);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2, 3});
  const bool open = ImGui::CollapsingHeader(title);
  if (open != was_open) sections[title] = open;
  ImGui::PopStyleVar();
  ImGui::PopFont();
  record(ui, std::string("section/") + title);
  return open;
}

void heading(const Context& ui, const char* title) {
  ImGui::Dummy({0, 2});
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(title);
  ImGui::PopFont();
}

void section_note(const Context& ui, const std::string& text, ImU32 color) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  ImGui::GetWindowDrawList()->AddText({right - size.x, 0.5f * (low.y + high.y - size.y)},
                                      color ? color : ui.colors.faint, text.c_str());
}

namespace {

// True if a text field in another window is active. A tooltip would cover that window.
bool is_typing_elsewhere() {
  const ImGuiContext& g = *GImGui;
  return g.IO.WantTextInput && g.ActiveIdWindow &&
         g.ActiveIdWindow->RootWindow != g.CurrentWindow->RootWindow;
}

// True if the last item needs a tooltip: the item is hovered but not pressed, and no other tooltip is shown.
bool wants_hint() {
  const ImGuiWindow* tooltip = ImGui::FindWindowByName("##Tooltip_00");
  return ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) && !ImGui::IsItemActive() &&
         !(tooltip && tooltip->Active) && !is_typing_elsewhere();
}

}  // namespace

bool take_escape(workspace::Workspace& w) {
  if (ImGui::IsMouseClicked(0) && !ImGui::IsMouseDoubleClicked(0)) workspace::begin_widget_edit(w);
  if (!key_pressed(workspace::Key::escape)) return false;
  const auto& popups = GImGui->OpenPopupStack;
  const bool in_dialog =
      !popups.empty() && popups[0].Window && (popups[0].Window->Flags & ImGuiWindowFlags_Modal);
  if (const int lists = in_dialog ? 1 : 0; popups.Size > lists) {
    ImGui::ClosePopupToLevel(lists, true);
    return true;
  }
  // Text fields and the timeline handle Esc themselves.
  if (!ImGui::IsMouseDown(0) || !ImGui::IsAnyItemActive() || ImGui::GetIO().WantTextInput || w.view.time.drag)
    return false;
  ImGui::ClearActiveID();
  ImGui::ClearDragDrop();
  workspace::cancel_widget_edit(w);
  return true;
}

namespace {

// The place of a tooltip: below the last item, otherwise above it, otherwise below the cursor.
ImVec2 hint_place(ImVec2 size) {
  constexpr float gap = 4, cursor_height = 20;
  const ImVec2 screen = ImGui::GetIO().DisplaySize, mouse = ImGui::GetIO().MousePos;
  const float below = ImGui::GetItemRectMax().y + gap, above = ImGui::GetItemRectMin().y - gap - size.y;
  const float y = below + size.y <= screen.y ? below : above >= 0 ? above : mouse.y + cursor_height;
  return {std::clamp(mouse.x, 0.0f, std::max(screen.x - size.x, 0.0f)), y};
}

}  // namespace

void hint(const std::string& text) {
  if (!wants_hint()) return;
  const ImVec2 padding{12, 8};  // some windows have no padding
  const std::string lines = wrapped(text, 268);
  const ImVec2 size = ImGui::CalcTextSize(lines.c_str());
  ImGui::SetNextWindowPos(hint_place({size.x + 2 * padding.x, size.y + 2 * padding.y}));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(lines.c_str());
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

std::string wrapped(const std::string& text, float width) {
  const float space = ImGui::CalcTextSize(" ").x;
  std::string lines;
  float x = 0;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const float wide = ImGui::CalcTextSize(word.c_str()).x;
    if (x > 0 && x + wide > width && lines.back() == ' ') {
      lines.back() = '\n';
      x = 0;
    }
    lines += word;
    x += wide + space;
    if (end < text.size()) lines += text[end];
    if (end < text.size() && text[end] == '\n') x = 0;
    begin = end + 1;
  }
  return lines;
}

std::string shortened(std::string text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  while (!text.empty() && ImGui::CalcTextSize((text + "...").c_str()).x > width)
    text = base::cut(text, text.size() - 1);
  return text + "...";
}

void command_button(const Context& ui, std::string_view name, float width) {
  const workspace::Command& command = require(name);
  const std::string label = std::string(command.brief) + "##" + std::string(name);
  if (button(ui, label.c_str(), std::string(name), hint_of(ui, command), {width, 0},
             command.enabled(ui.workspace)))
    command.run(ui.workspace);
}

void command_row(const Context& ui, std::initializer_list<std::string_view> commands) {
  const auto n = static_cast<float>(commands.size());
  const float width = (ImGui::GetContentRegionAvail().x - (n - 1) * ImGui::GetStyle().ItemSpacing.x) / n;
  for (const auto& command : commands) {
    if (command != *commands.begin()) ImGui::SameLine();
    command_button(ui, command, width);
  }
}

void command_choice(const Context& ui, std::initializer_list<std::string_view> commands, std::size_t chosen) {
  const auto n = static_cast<float>(commands.size());
  const float width = (ImGui::GetContentRegionAvail().x - (n - 1) * ImGui::GetStyle().ItemInnerSpacing.x) / n;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (i > 0) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    const int colors = i == chosen ? 2 : 0;
    if (i == chosen) ImGui::PushStyleColor(ImGuiCol_Button, ui.colors.card_active);
    if (i == chosen) ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.accent);
    command_button(ui, commands.begin()[i], width);
    ImGui::PopStyleColor(colors);
  }
}

void command_toggle(const Context& ui, std::string_view name, std::optional<bool> value) {
  const workspace::Command& command = require(name);
  bool on = value.value_or(command.on(ui.workspace));
  const std::string label = std::string(command.brief) + "##" + std::string(name);
  if (ImGui::Checkbox(label.c_str(), &on)) command.run(ui.workspace);
  record(ui, std::string(name));
  hint(hint_of(ui, command));
}

std::string method_label(workspace::Method method) {
  return std::string(label(method));
}

const workspace::MethodSample* running_sample(const workspace::Workspace& w) {
  const auto& methods = analysis::compared_methods;
  const auto at = std::ranges::find(methods, w.document.method());
  const bool known = w.document.deformer().exponential() && w.frame.methods.matrices > 0 &&
                     at != methods.end() && document::differs_from_rest(w.document);
  return known ? &w.frame.methods.samples[static_cast<std::size_t>(at - methods.begin())] : nullptr;
}

void text_right(const Context& ui, float x, const std::string& text, ImU32 color, std::optional<float> line) {
  ImGui::PushFont(ui.fonts.numbers);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float y = line.value_or(ImGui::GetCursorScreenPos().y) + 0.5f * (ImGui::GetTextLineHeight() - size.y);
  ImGui::GetWindowDrawList()->AddText({x - size.x, y}, color, text.c_str());
  ImGui::PopFont();
}

void value_row(const Context& ui, const char* label, const std::string& value, ImU32 color) {
  const float width = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
  text_right(ui, ImGui::GetCursorScreenPos().x + width, value, color ? color : ui.colors.text);
  text_in(ui.colors.faint, shortened(label, width - ImGui::CalcTextSize(value.c_str()).x - gap));
}

// Uses InputText because InputDouble rejects commas and, in older versions, lacks EnterReturnsTrue.
std::optional<double> number_field(const Context& ui, const std::string& name, double value, float width,
                                   const char* tip, bool enabled) {
  if (width != 0) ImGui::SetNextItemWidth(width);
  const std::string shown = printed(value, ImGui::CalcItemWidth() - 2 * ImGui::GetStyle().FramePadding.x);
  const auto typed = text_field(ui, name, shown, tip, enabled, filter_number);
  if (!typed || typed->empty() || *typed == shown) return std::nullopt;
  const auto number = interact::number_of(*typed);
  if (!number) ui.workspace.messages.warn('"' + *typed + "\" is not a number; nothing was changed");
  return number;
}

bool types_into_slider(const workspace::Workspace& w) {
  return !w.panels.typed_slider.name.empty() && w.panels.typed_slider.frame + 1 >= ImGui::GetFrameCount();
}

namespace {

constexpr int frames_to_focus = 4;

// The field that replaces a slider. The field gets the keyboard focus after the mouse button is released.
std::optional<double> slider_field(const Context& ui, const std::string& name, double value) {
  workspace::TypedSlider& typing = ui.workspace.panels.typed_slider;
  typing.frame = ImGui::GetFrameCount();
  const bool released = !ImGui::IsMouseDown(0);
  if (released && typing.waits == frames_to_focus) ImGui::SetKeyboardFocusHere();
  const auto typed = number_field(ui, name + "/field", value);
  if (ImGui::IsItemActive()) {
    typing.waits = 0;
  } else if (released && typing.waits-- <= 0) {
    typing = {};
  }
  return typed;
}

}  // namespace

Slid slider(const Context& ui, const std::string& name, double value, double least, double most,
            const std::function<bool()>& draw, bool enabled) {
  Slid slid;
  if (types_into_slider(ui.workspace) && ui.workspace.panels.typed_slider.name == name) {
    slid.typed = slider_field(ui, name, value);
    if (slid.typed) slid.typed = *slid.typed >= least ? std::min(*slid.typed, most) : least;
  } else {
    slid.moved = draw();
    const bool twice = ImGui::IsMouseDoubleClicked(0);
    if (ImGui::IsItemActivated() && (twice || ImGui::GetIO().KeyCtrl)) {
      ImGui::ClearActiveID();
      if (twice) workspace::cancel_widget_edit(ui.workspace);  // the first click has moved the slider
      ui.workspace.panels.typed_slider = {name, ImGui::GetFrameCount(), frames_to_focus};
      slid.moved = false;
    }
  }
  record(ui, name, enabled);
  return slid;
}

std::optional<double> slider(const Context& ui, const std::string& name, double value, const SliderLook& look,
                             float width) {
  auto moved = static_cast<float>(value);
  constexpr auto usual = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput;
  ImGui::SetNextItemWidth(width);
  const Slid slid = slider(
      ui, name, value, look.least, look.most,
      [&] {
        return ImGui::SliderFloat(("##" + name).c_str(), &moved, static_cast<float>(look.least),
                                  static_cast<float>(look.most), look.format,
                                  look.logarithmic ? usual | ImGuiSliderFlags_Logarithmic : usual);
      },
      look.enabled);
  hint(look.tip);
  if (!slid.moved) return slid.typed;
  const double to = std::clamp(static_cast<double>(moved), look.least, look.most);
  return look.rounded ? look.rounded(to) : to;
}

std::optional<double> slider_row(const Context& ui, const char* label, float distance,
                                 const std::string& name, double value, const std::string& shown,
                                 const SliderLook& look) {
  constexpr float value_width = 52;
  row_label(label, distance);
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  const auto chosen = slider(ui, name, value, look, -value_width);
  value_beside(right, shown);
  return chosen;
}

std::optional<std::string> name_field(const Context& ui, const std::string& id, const std::string& name,
                                      float width, const char* what) {
  ImGui::SetNextItemWidth(width);
  return text_field(ui, id, name, what);
}

std::optional<std::size_t> recent_list(const Context& ui) {
  constexpr std::size_t most = 4;
  const auto& recent = ui.workspace.preferences.recent;
  std::optional<std::size_t> clicked;
  for (std::size_t i = 0; i < std::min(most, recent.size()); ++i) {
    const std::string name = recent[i].file.filename().string();
    const float y = ImGui::GetCursorScreenPos().y, width = ImGui::GetContentRegionAvail().x,
                right = ImGui::GetCursorScreenPos().x + width;
    if (ImGui::Selectable((name + "##recent" + std::to_string(i)).c_str())) clicked = i;
    record(ui, "recent/" + std::to_string(i));
    hint("Open " + place_of(recent[i]));
    // Show the folder too, because many files have the same name.
    const std::string folder = recent[i].file.parent_path().filename().string();
    text_right(ui, right, shortened(folder, width - ImGui::CalcTextSize(name.c_str()).x - 16),
               ui.colors.faint, y);
  }
  return clicked;
}

std::string place_of(const workspace::RecentFile& recent) {
  return recent.file.string() + (recent.cage.empty() ? "" : "  in  " + recent.cage.string());
}

void open_recent(workspace::Workspace& w, std::size_t index) {
  const workspace::RecentFile& file = w.preferences.recent[index];
  w.jobs.wishes.open({files::OpenRequest::What::model, {file.file, file.cage}});
}

void note(const Context& ui, const std::string& text, ImU32 color) {
  ImGui::PushTextWrapPos(0);  // for words that are longer than a line
  text_in(color ? color : ui.colors.faint, wrapped(text, ImGui::GetContentRegionAvail().x));
  ImGui::PopTextWrapPos();
}

void note_within(const Context& ui, int lines, const std::string& text, ImU32 color) {
  const float line = ImGui::GetCursorPosY();
  note(ui, text, color);
  const float end = line + static_cast<float>(lines) * ImGui::GetTextLineHeightWithSpacing();
  const float left = end - ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y;
  if (left > 0) ImGui::Dummy({0, left});
}

std::string error(double relative) {
  if (std::isnan(relative)) return "NaN";
  return relative == 0 ? "0" : formatted("%.1e", relative);
}

std::string rough_error(double relative) {
  if (std::isnan(relative) || relative == 0) return error(relative);
  std::string text = formatted("%.0e", relative);
  if (const auto zero = text.find("e-0"); zero != std::string::npos) text.erase(zero + 2, 1);
  return text;
}

}  // namespace viete::ui
