// ImGui's widgets as the panels use them: named for tests, with a hint, and a reason when disabled.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "scene/workspace/command.h"
#include "ui/context.h"

namespace viete::ui {

/// As large as what it holds, at its place, and nothing that is typed goes to it.
inline constexpr ImGuiWindowFlags fixed_flags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
inline constexpr ImGuiWindowFlags sized_flags = fixed_flags | ImGuiWindowFlags_AlwaysAutoResize;
inline constexpr ImGuiWindowFlags card_flags =
    sized_flags | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
/// With a title, and a cross that closes it.
inline constexpr ImGuiWindowFlags dialog_flags = ImGuiWindowFlags_NoCollapse |
                                                 ImGuiWindowFlags_NoSavedSettings |
                                                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove;

/// A window over the view, to the end of the scope.
class Window {
public:
  struct Place {
    ImVec2 at;
    ImVec2 pivot{0.5f, 0.5f};  ///< what of it is there: {0, 0} is its corner
    ImVec2 size{0, 0};         ///< 0: as its flags say
    float rounding = 8;
    ImVec2 padding{-1, -1};  ///< -1: as in other windows
    float border = 0;
  };
  Window(const char* name, const Place& place, ImGuiWindowFlags flags, bool* open = nullptr);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
};

/// In the middle of the view's width, so far down in the window; and in its middle.
ImVec2 middle_at(const Context& ui, float y);
ImVec2 middle_of_view(const Context& ui);

/// Text in a colour, to the end of its line.
void text_in(ImU32 color, const std::string& text);
/// A word before what begins at this distance from the left.
void row_label(const char* text, float distance);
/// What a slider stands at: beside it, right edge at `right`.
void value_beside(float right, const std::string& value);
void progress_bar(const Context& ui, float width, double done);
/// A field for a few letters of a command's name, which has the keyboard at first.
void search_field(const Context& ui, const char* name, std::string& typed, bool& appearing);

/// Notes the last item's place under `name` when a recorder watches.
void record(const Context& ui, const std::string& name, bool enabled = true);

/// The title of what is always there.
void heading(const Context& ui, const char* title);
/// A collapsible section; true when open. Calls nothing to end.
bool section(const Context& ui, const char* title, bool open_at_first = true);
/// A few quiet words at the right of the section's line, to be read while it is closed too.
void section_note(const Context& ui, const std::string& text, ImU32 color = 0);

/// A button that runs a command: its label, its hint and key as tooltip, disabled when the command is.
void command_button(const Context& ui, std::string_view command, float width = 0);
/// Several of them in a row, sharing the width evenly.
void command_row(const Context& ui, std::initializer_list<std::string_view> commands);
/// The same for commands of which one is in force: that one is marked.
void command_choice(const Context& ui, std::initializer_list<std::string_view> commands, std::size_t chosen);
/// A checkbox that runs a toggling command; without a value: of one that says itself whether it is on.
void command_toggle(const Context& ui, std::string_view command, std::optional<bool> value = {});

/// What a command does, its key, and why it cannot run now.
std::string hint_of(const Context& ui, const scene::Command& command);

ImU32 severity_color(const Context& ui, scene::Severity severity);
/// "Error: ...  (3 times)".
std::string message_text(const scene::Message& message);

/// The method's label on its button.
std::string method_label(scene::Method method);
/// What was measured of the method that runs; null where it is not used, or at rest, where there is nothing
/// to measure.
const scene::MethodSample* running_sample(const scene::Workspace& workspace);

/// "label ........ value" on one line, the value right-aligned in tabular figures.
void value_row(const Context& ui, const char* label, const std::string& value, ImU32 color = 0);
/// A wrapped line in a quiet colour.
void note(const Context& ui, const std::string& text, ImU32 color = 0);
/// The same with room for so many lines, whatever it says: what comes below stays where it is.
void note_within(const Context& ui, int lines, const std::string& text, ImU32 color = 0);
/// The text in lines of at most this width, broken between words alone: ImGui would break "3.7e-16" at its
/// point. A word that is wider keeps a line of its own.
std::string wrapped(const std::string& text, float width);
/// As much of a text as there is room for, with "..." for the rest.
std::string shortened(std::string text, float width);
/// A tooltip for the last item, wrapped.
void hint(const std::string& text);
/// Whether the last item is to have one: the mouse rests on it, holds nothing, and no other has one.
bool wants_hint();

/// Before anything else takes a frame's Esc: it closes what has dropped down, or lets go of the widget that
/// the mouse holds, as if it had never been touched. True if it did either.
bool take_escape(scene::Workspace& workspace);

/// A field for a number, with a decimal point or comma: shows `value`, and gives what was typed when it is
/// left by Enter or a click elsewhere; nothing while it is being edited, after Esc, and if no digit was
/// changed. What is no number is said in the messages.
std::optional<double> number_field(const Context& ui, const std::string& name, double value);

/// How a person has changed a slider.
struct Slid {
  bool moved = false;
  std::optional<double> typed{};  ///< within its range
};
/// A slider whose number `value`, from `least` to `most`, can be typed as well: a double click or Ctrl+click
/// makes it a field until that is left. `draw` draws it, and says whether it was moved.
Slid slider(const Context& ui, const std::string& name, double value, double least, double most,
            const std::function<bool()>& draw, bool enabled = true);
/// True while a number is typed into a slider.
bool types_into_slider(const scene::Workspace& workspace);

/// A name to be typed over, at most 199 bytes: what was typed, when the field is left; nothing while it is
/// being edited, and after Esc.
std::optional<std::string> name_field(const Context& ui, const std::string& id, const std::string& name,
                                      float width, const char* what);

/// The newest recent files, at most so many, a line each, that one marked; gives the one that is clicked.
std::optional<std::size_t> recent_list(const Context& ui, std::size_t most,
                                       std::size_t chosen = scene::FileBrowser::none);
/// With its cage.
void open_recent(scene::Workspace& workspace, std::size_t index);

/// Text of the numbers font, right edge at x, on the line that comes next or the one that begins at y = line.
void text_right(const Context& ui, float x, const std::string& text, ImU32 color);
void text_right(const Context& ui, float x, const std::string& text, ImU32 color, float line);

}  // namespace viete::ui
