// Widgets of the panels, with names for tests and tooltips; lists of choices; formats of numbers.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/text.h"
#include "ui/context.h"
#include "workspace/command.h"
#include "workspace/command_tables.h"

namespace viete::ui {

/// Windows at a fixed position without decoration.
inline constexpr ImGuiWindowFlags fixed_flags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
inline constexpr ImGuiWindowFlags sized_flags = fixed_flags | ImGuiWindowFlags_AlwaysAutoResize;
inline constexpr ImGuiWindowFlags card_flags =
    sized_flags | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
/// Windows with a title and a close button.
inline constexpr ImGuiWindowFlags dialog_flags = ImGuiWindowFlags_NoCollapse |
                                                 ImGuiWindowFlags_NoSavedSettings |
                                                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove;

/// Windows without keyboard focus.
inline constexpr ImGuiWindowFlags passive_flags =
    fixed_flags | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

/// A window over the view, until the end of the scope.
class Window {
public:
  struct Place {
    ImVec2 at;
    ImVec2 pivot{0.5f, 0.5f};  ///< which point of the window is at `at`; {0, 0}: the upper left corner
    ImVec2 size{0, 0};         ///< 0: ImGui chooses the size
    float rounding = 8;
    ImVec2 padding{-1, -1};  ///< -1: the default
    float border = 0;
  };
  Window(const char* name, const Place& place, ImGuiWindowFlags flags);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
};

/// A modal dialog, until the end of the scope: mouse buttons and keys reach only this window.
class Dialog {
public:
  /// `open`, if given, adds a close button, which sets `open` to false.
  Dialog(const char* name, const Window::Place& place, ImGuiWindowFlags flags, bool* open = nullptr);
  ~Dialog();
  Dialog(const Dialog&) = delete;
  Dialog& operator=(const Dialog&) = delete;
  /// False if the dialog has no content in this picture, because it was just closed.
  explicit operator bool() const { return shown_; }

private:
  bool shown_;
};
/// Call after all dialogs. Closes a dialog that was not drawn in this picture.
void close_unused_dialog();
/// True if a dialog, a menu or a list is open. It gets all keys.
bool is_popup_open();

/// The point at height y in the horizontal middle of the view.
ImVec2 middle_at(const Context& ui, float y);
ImVec2 middle_of_view(const Context& ui);

void text_in(ImU32 color, const std::string& text);
/// A label. The next item begins at `distance` from the left.
void row_label(const char* text, float distance);
/// Text beside a slider, right aligned at `right`.
void value_beside(float right, const std::string& value);
void progress_bar(const Context& ui, float width, double done);
/// A search field for commands. If `appearing`, the field gets the keyboard focus.
void search_field(const Context& ui, const char* name, std::string& typed, bool& appearing);

/// Records the last item's rectangle under `name` if there is a recorder.
void record(const Context& ui, const std::string& name, bool enabled = true);

/// A button with a name for tests and a tooltip. Returns true if clicked.
bool button(const Context& ui, const char* label, const std::string& name, const std::string& tip,
            ImVec2 size = {0, 0}, bool enabled = true);
void checkbox(const Context& ui, const char* label, const std::string& name, bool& on, const char* tip);
/// Begins a drop-down list. If the result is true, add entries and call ImGui::EndCombo(). The tooltip is
/// shown while the list is closed. In an open list, the arrow keys mark an entry and Enter chooses it.
bool begin_list(const Context& ui, const std::string& name, const char* shown, const std::string& tip);
bool list_entry(const Context& ui, std::string_view label, const std::string& name, bool chosen,
                std::string_view tip);
/// The background of a large button.
void card(const Context& ui, ImVec2 low, ImVec2 high, bool active);

/// The title of a section that cannot be collapsed.
void heading(const Context& ui, const char* title);
/// A collapsible section. Returns true if it is open. Needs no end call.
bool section(const Context& ui, const char* title, bool open_at_first = true);
/// A short text at the right of the section's header.
void section_note(const Context& ui, const std::string& text, ImU32 color = 0);

/// A button that runs a command. The tooltip shows the command's hint and key.
void command_button(const Context& ui, std::string_view command, float width = 0);
void command_row(const Context& ui, std::initializer_list<std::string_view> commands);
/// Like command_row(), with the button `chosen` marked.
void command_choice(const Context& ui, std::initializer_list<std::string_view> commands, std::size_t chosen);
/// A checkbox that runs a toggling command. Shows `value`, or the state of the command if `value` is missing.
void command_toggle(const Context& ui, std::string_view command, std::optional<bool> value = {});

/// The command's hint and key, and the reason if the command is disabled.
std::string hint_of(const Context& ui, const workspace::Command& command);

ImU32 severity_color(const Context& ui, workspace::Severity severity);
/// For example "Error: ...  (3 times)".
std::string message_text(const workspace::Message& message);

std::string method_label(workspace::Method method);
/// The measurements of the current method. Null at rest, without exponentials, and before a measurement.
const workspace::MethodSample* running_sample(const workspace::Workspace& workspace);

/// A line with a label on the left and a value on the right.
void value_row(const Context& ui, const char* label, const std::string& value, ImU32 color = 0);
/// Wrapped text in a dim colour, or in `color`.
void note(const Context& ui, const std::string& text, ImU32 color = 0);
/// Like note(), with a height of at least this number of lines, so that items below do not move.
void note_within(const Context& ui, int lines, const std::string& text, ImU32 color = 0);
/// Breaks the text at spaces into lines of at most `width`. A word longer than `width` gets its own line.
/// ImGui would also break "3.7e-16" at the point.
std::string wrapped(const std::string& text, float width);
/// Truncates a text to the width, with "..." at the end.
std::string shortened(std::string text, float width);
/// A wrapped tooltip beside the last item.
void hint(const std::string& text);

/// On a mouse press, begins an edit that Esc can cancel. If Esc is pressed, closes the open popup, or cancels
/// the active widget and restores its value. Returns true if Esc was used. Call before other uses of Esc.
bool take_escape(workspace::Workspace& workspace);

/// A field that shows `value`. Returns the typed number when the field loses the focus by Enter or a click
/// elsewhere; nullopt during editing, after Esc, and if the text is unchanged. The decimal sign is a point or
/// a comma. A message reports an invalid number.
std::optional<double> number_field(const Context& ui, const std::string& name, double value, float width = 0,
                                   const char* tip = "", bool enabled = true);

struct Slid {
  bool moved = false;
  std::optional<double> typed{};  ///< clamped to the slider's range
};
/// A slider for `value`, from `least` to `most`. A double click or Ctrl+click replaces the slider by a number
/// field. `draw` must draw the slider and return true if the slider was moved.
Slid slider(const Context& ui, const std::string& name, double value, double least, double most,
            const std::function<bool()>& draw, bool enabled = true);
struct SliderLook {
  double least, most;
  const char* format = "";  ///< text on the slider, as for printf
  const char* tip = "";
  bool logarithmic = false;
  double (*rounded)(double) = nullptr;  ///< null: no rounding
  bool enabled = true;
};
/// A slider. Returns the new value if the user moved the slider or typed a number.
std::optional<double> slider(const Context& ui, const std::string& name, double value, const SliderLook& look,
                             float width = -1);
/// A row with a label, the slider of slider(), and the text `shown`.
std::optional<double> slider_row(const Context& ui, const char* label, float distance,
                                 const std::string& name, double value, const std::string& shown,
                                 const SliderLook& look);
bool types_into_slider(const workspace::Workspace& workspace);

/// A text field for a name of at most 199 bytes. Returns the text when the field loses the focus; nullopt
/// during editing and after Esc.
std::optional<std::string> name_field(const Context& ui, const std::string& id, const std::string& name,
                                      float width, const char* what);

/// Lists the newest four recent files. Returns the index of the clicked file.
std::optional<std::size_t> recent_list(const Context& ui);
/// For example "model.obj  in  cage.obj", with full paths.
std::string place_of(const workspace::RecentFile& recent);
void open_recent(workspace::Workspace& workspace, std::size_t index);

/// Text in the font for numbers, right aligned at x. `line` is its top edge; the default is the current line.
void text_right(const Context& ui, float x, const std::string& text, ImU32 color,
                std::optional<float> line = {});

using base::formatted;
using base::milliseconds;
using base::nanoseconds;

/// Beside times that are too long, see workspace::FrameTimes::busy.
inline constexpr std::string_view busy_words = "the computer is busy";

/// For example "50,000".
inline std::string count(std::size_t n) {
  return base::with_thousands(n);
}
/// For example "3.1e-16". Exactly 0 gives "0", NaN gives "NaN".
std::string error(double relative);
/// With one digit, for example "3e-16".
std::string rough_error(double relative);

struct ChoiceListWords {
  const char* prefix = "";  ///< prefix of the entries' widget names, for tests
  const char* none = "";    ///< text shown if no value is chosen
  const char* about = "";   ///< tooltip that replaces the value's tooltip
};

/// A drop-down list of all values, with the current value marked.
template <class Value>
void choice_list(const Context& ui, const std::string& name, std::optional<Value> now, float width,
                 const ChoiceListWords& words = {}) {
  ImGui::SetNextItemWidth(width);
  const char* const shown = now ? base::entry_of(*now).label.data() : words.none;
  const std::string about = *words.about || !now ? words.about : std::string(base::entry_of(*now).hint);
  if (!begin_list(ui, name, shown, about)) return;
  const std::span<const base::Choice> all = choices(Value{});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto value = static_cast<Value>(i);
    const workspace::Command& command = *workspace::find_command(workspace::choice_command_name(value));
    if (list_entry(ui, all[i].label, words.prefix + command.name, value == now, all[i].hint) &&
        command.enabled(ui.workspace))
      command.run(ui.workspace);
  }
  ImGui::EndCombo();
}

/// Like choice_list(), without commands. Returns the newly chosen value, or nullopt.
template <class Value>
std::optional<Value> entry_list(const Context& ui, const std::string& name, std::optional<Value> now,
                                const char* none = "") {
  std::optional<Value> chosen;
  const char* const shown = now ? base::entry_of(*now).label.data() : none;
  if (!begin_list(ui, name, shown, now ? std::string(base::entry_of(*now).hint) : "")) return chosen;
  for (const Value value : base::all_values<Value>()) {
    const base::Choice& entry = base::entry_of(value);
    if (list_entry(ui, entry.label, name + '_' + std::string(entry.word), value == now, entry.hint))
      chosen = value;
  }
  ImGui::EndCombo();
  return chosen;
}

}  // namespace viete::ui
