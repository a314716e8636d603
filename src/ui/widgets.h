// ImGui widgets of the panels: named for tests, with hints, and with a reason when disabled.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "ui/context.h"
#include "workspace/command.h"

namespace viete::ui {

/// Fixed position, sized to its content, without keyboard input.
inline constexpr ImGuiWindowFlags fixed_flags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
inline constexpr ImGuiWindowFlags sized_flags = fixed_flags | ImGuiWindowFlags_AlwaysAutoResize;
inline constexpr ImGuiWindowFlags card_flags =
    sized_flags | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
/// With a title and a close button.
inline constexpr ImGuiWindowFlags dialog_flags = ImGuiWindowFlags_NoCollapse |
                                                 ImGuiWindowFlags_NoSavedSettings |
                                                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove;

/// Without keyboard input or focus.
inline constexpr ImGuiWindowFlags passive_flags =
    fixed_flags | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

/// A window over the view, until the end of the scope.
class Window {
public:
  struct Place {
    ImVec2 at;
    ImVec2 pivot{0.5f, 0.5f};  ///< anchor point in the window: {0, 0} is its corner
    ImVec2 size{0, 0};         ///< 0: determined by the flags
    float rounding = 8;
    ImVec2 padding{-1, -1};  ///< -1: the default
    float border = 0;
  };
  Window(const char* name, const Place& place, ImGuiWindowFlags flags, bool* open = nullptr);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
};

/// The view's horizontal middle at height y; and the view's center.
ImVec2 middle_at(const Context& ui, float y);
ImVec2 middle_of_view(const Context& ui);

/// Coloured text up to the end of its line.
void text_in(ImU32 color, const std::string& text);
/// A label before an item at this distance from the left.
void row_label(const char* text, float distance);
/// The value of a slider, next to it, right aligned at `right`.
void value_beside(float right, const std::string& value);
void progress_bar(const Context& ui, float width, double done);
/// A search field for commands, focused when it appears.
void search_field(const Context& ui, const char* name, std::string& typed, bool& appearing);

/// Records the last item's rectangle under `name` if there is a recorder.
void record(const Context& ui, const std::string& name, bool enabled = true);

/// A button with its name for tests and its tooltip; true if clicked.
bool button(const Context& ui, const char* label, const std::string& name, const std::string& tip,
            ImVec2 size = {0, 0}, bool enabled = true);
void checkbox(const Context& ui, const char* label, const std::string& name, bool& on, const char* tip);
/// A list to choose from: its tooltip while it is closed. If true, entries and ImGui::EndCombo() follow.
bool begin_list(const Context& ui, const std::string& name, const char* shown, const std::string& tip);
bool list_entry(const Context& ui, std::string_view label, const std::string& name, bool chosen,
                std::string_view tip);
/// The background of a large button, from its rectangle; accented while it is active.
void card(const Context& ui, ImVec2 low, ImVec2 high, bool active);

/// The title of a section that cannot be collapsed.
void heading(const Context& ui, const char* title);
/// A collapsible section; true when open. Needs no end call.
bool section(const Context& ui, const char* title, bool open_at_first = true);
/// A short dim text at the right of the section's header, visible while it is closed too.
void section_note(const Context& ui, const std::string& text, ImU32 color = 0);

/// A button that runs a command: its label, its hint and key as tooltip, disabled like the command.
void command_button(const Context& ui, std::string_view command, float width = 0);
/// Several command buttons in a row of equal widths.
void command_row(const Context& ui, std::initializer_list<std::string_view> commands);
/// As command_row(), with the active one marked.
void command_choice(const Context& ui, std::initializer_list<std::string_view> commands, std::size_t chosen);
/// A checkbox that runs a toggling command; without `value` the command provides the state.
void command_toggle(const Context& ui, std::string_view command, std::optional<bool> value = {});

/// The command's action, its key, and why it is disabled.
std::string hint_of(const Context& ui, const workspace::Command& command);

ImU32 severity_color(const Context& ui, workspace::Severity severity);
/// "Error: ...  (3 times)".
std::string message_text(const workspace::Message& message);

/// The method's label on its button.
std::string method_label(workspace::Method method);
/// The measurements of the running method; null if it is unused, or at rest, where there is nothing to
/// measure.
const workspace::MethodSample* running_sample(const workspace::Workspace& workspace);

/// "label ........ value" on one line, the value right-aligned in tabular figures.
void value_row(const Context& ui, const char* label, const std::string& value, ImU32 color = 0);
/// A wrapped line in a dim colour.
void note(const Context& ui, const std::string& text, ImU32 color = 0);
/// A note with a fixed height in lines, so that items below do not move.
void note_within(const Context& ui, int lines, const std::string& text, ImU32 color = 0);
/// Wraps the text to lines of at most this width, at spaces only: ImGui would break "3.7e-16" at its point. A
/// longer word gets its own line.
std::string wrapped(const std::string& text, float width);
/// Truncates a text to the width, with "..." at the end.
std::string shortened(std::string text, float width);
/// A wrapped tooltip for the last item.
void hint(const std::string& text);
/// True if the last item needs a tooltip: the mouse rests on it, no button is pressed, and no other is shown.
bool wants_hint();

/// Call before other uses of Esc in a frame: closes a popup, or cancels the active widget and restores its
/// value. True if it did either.
bool take_escape(workspace::Workspace& workspace);

/// A number field with a decimal point or comma: shows `value`, and returns the typed number when it loses
/// the focus by Enter or a click elsewhere; nullopt while editing, after Esc, and if no digit changed.
/// Invalid numbers are reported as messages.
std::optional<double> number_field(const Context& ui, const std::string& name, double value, float width = 0,
                                   const char* tip = "", bool enabled = true);

/// The user's change of a slider.
struct Slid {
  bool moved = false;
  std::optional<double> typed{};  ///< within its range
};
/// A slider for `value`, from `least` to `most`, with text entry: a double click or Ctrl+click turns it into
/// a field until it loses the focus. `draw` draws it and returns true if it was moved.
Slid slider(const Context& ui, const std::string& name, double value, double least, double most,
            const std::function<bool()>& draw, bool enabled = true);
/// The usual slider: its range, its text and flags of ImGui, its tooltip, and how values are rounded.
struct SliderLook {
  double least, most;
  const char* format = "";
  const char* tip = "";
  bool logarithmic = false;
  double (*rounded)(double) = nullptr;
  bool enabled = true;
};
/// Returns the value that it was moved to, or that was typed.
std::optional<double> slider(const Context& ui, const std::string& name, double value, const SliderLook& look,
                             float width = -1);
/// As above, after a label and before the value as text.
std::optional<double> slider_row(const Context& ui, const char* label, float distance,
                                 const std::string& name, double value, const std::string& shown,
                                 const SliderLook& look);
/// True while a number is being typed into a slider.
bool types_into_slider(const workspace::Workspace& workspace);

/// A text field for a name, at most 199 bytes: returns the text when the field loses the focus; nullopt while
/// editing, and after Esc.
std::optional<std::string> name_field(const Context& ui, const std::string& id, const std::string& name,
                                      float width, const char* what);

/// The newest four recent files, one per line; returns the clicked one.
std::optional<std::size_t> recent_list(const Context& ui);
/// "FILE  in  CAGE".
std::string place_of(const workspace::RecentFile& recent);
/// Opens it with its cage.
void open_recent(workspace::Workspace& workspace, std::size_t index);

/// Text in the numbers font, right aligned at x, on the next line or the line at y = line.
void text_right(const Context& ui, float x, const std::string& text, ImU32 color);
void text_right(const Context& ui, float x, const std::string& text, ImU32 color, float line);

}  // namespace viete::ui
