// Draws the panels, one function each. Also sets fonts and colours, handles input, and describes mouse
// actions.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ui/context.h"
#include "workspace/command.h"
#include "workspace/keymap.h"

namespace viete::workspace {
class Pointer;
}  // namespace viete::workspace

namespace viete::ui {

/// Replaces the fonts of ImGui; call between frames. `scale` is in device pixels per logical pixel. If
/// `builtin_only` is true, or if no font file is found, adds ImGui's bitmap font. This font looks the same on
/// all machines. The fonts have Latin-1 and, where a font of the system has them, these characters.
Fonts add_fonts(float scale, bool builtin_only, const std::set<char32_t>& characters = {});

/// The characters after Latin-1 in the names and messages that panels can show, and in typed text. Call
/// between ImGui::NewFrame() and ImGui::Render().
std::set<char32_t> shown_characters(const workspace::Workspace& workspace);

/// Sets sizes, spacing and colours; call when the theme changes.
void apply_style(bool dark);

/// Runs commands for pressed keys and passes the mouse to the pointer. Call once per frame, after
/// ImGui::NewFrame(). Input over a panel or in a text field goes to the panel. A gesture that began in the
/// view continues over panels.
void handle_input(workspace::Workspace& workspace, workspace::Pointer& pointer);

/// Draws all panels and overlays. The user's actions change the workspace.
void draw_panels(const Context& ui);

void menu_bar(const Context& ui);
/// A menu line that runs a command. Shows the command's label, or `called` if given. Returns true if chosen.
bool menu_item(const Context& ui, const workspace::Command& command, std::string_view called = "");
/// The menu of a widget, if it was opened by ImGui::OpenPopup(name).
void command_menu(const Context& ui, const char* name, std::initializer_list<std::string_view> commands);
void context_menu(const Context& ui);  ///< opened by a right click
void tool_strip(const Context& ui);    ///< icons of the tools, in the view
void command_palette(const Context& ui);
void key_list(const Context& ui);      ///< all commands and their keys, editable
void column_edges(const Context& ui);  ///< column borders to drag, and tabs to show or hide columns

void panel_model(const Context& ui);
void panel_cage(const Context& ui);
void panel_select(const Context& ui);  ///< selection tools and selection sets
void panel_making(const Context& ui);  ///< settings of cage generation
void panel_transform(const Context& ui);
void panel_probes(const Context& ui);
void panel_poses(const Context& ui);     ///< named poses and their weights
void timeline_panel(const Context& ui);  ///< below the view
void panel_checks(const Context& ui);
void panel_method(const Context& ui);
void panel_timings(const Context& ui);
void panel_deformer(const Context& ui);
void panel_custom(const Context& ui);  ///< weights, blend and ARAP
void panel_map(const Context& ui);
void panel_views(const Context& ui);
void panel_vertex(const Context& ui);    ///< the vertex inspector
void vertex_overlay(const Context& ui);  ///< the inspected vertex and the elements that influence it
void split_overlay(const Context& ui);
void panel_display(const Context& ui);
void status_bar(const Context& ui);
void file_panel(const Context& ui);
void question_panel(const Context& ui);        ///< see workspace/messages.h; there must be a question
void preferences_dialog(const Context& ui);    ///< and the list of recovered edits
void message_log(const Context& ui);           ///< all messages
void toasts(const Context& ui, float bottom);  ///< recent messages, above `bottom`
// The next four functions draw a notice above the height `bottom`. They return the height of the notice's
// top, or `bottom` if there is no notice.
float cage_offer(const Context& ui, float bottom);    ///< suggests to get a cage, or to enclose the model
float key_question(const Context& ui, float bottom);  ///< the choice of a keymap at the first start
float work_bar(const Context& ui, float bottom);      ///< running work, with progress and Cancel
float map_legend(const Context& ui, float bottom);    ///< the meaning of the colours of the mesh
/// Returns a text such as "1 problem, 2 notes". `of_pose` is the number of problems of the pose.
std::string checks_summary(const workspace::CheckState& checks, std::size_t of_pose);
inline constexpr float tiny_legend_height = 56;  ///< of the smallest legend of a map, with its margin
/// Draws picture, name and date of recovered edits. Returns true if a click restores them.
bool recovery_card(const Context& ui, const files::RecoveryFile& file, const std::string& id, float width);
inline constexpr float recovery_card_height = 46;
float notice_room(const Context& ui);      ///< the width for notices, without the tools
void notice_bar(const Context& ui);        ///< offers to restore recovered edits
void transform_fields(const Context& ui);  ///< number fields of the tool
void hand_overlay(const Context& ui);      ///< mirror partners, soft radius and pivot
void probe_overlay(const Context& ui);
void gizmo_overlay(const Context& ui);
void axis_overlay(const Context& ui);
void torn_overlay(const Context& ui);  ///< edges where the mesh may fold, see pose_notes()
document::SelectMode select_mode();    ///< according to Shift and Ctrl
std::string select_hint(const workspace::Workspace& workspace);  ///< help for the selection tools, or empty
std::string mouse_text(const workspace::Workspace& workspace);   ///< help for the current mouse actions
void view_overlay(const Context& ui);                            ///< selection tools, brush and hints

struct MouseLine {
  std::string action, what;
};

std::vector<MouseLine> mouse_lines(const workspace::Keymap& keymap);

/// Describes camera navigation. Two spaces separate the phrases.
std::string looking_words(const workspace::Keymap& keymap);
/// Describes the effect of a drag on empty space, and camera navigation.
std::string empty_space_words(const workspace::Keymap& keymap);

/// The command's first key, or its label in quotes if it has no key.
std::string key_or_label(const workspace::Keymap& keymap, std::string_view command);

}  // namespace viete::ui
