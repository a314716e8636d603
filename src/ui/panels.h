// The panels, one function each.
#pragma once

#include <string_view>

#include "ui/context.h"

namespace viete::workspace {
struct Command;
}

namespace viete::ui {

/// All panels: columns, status bar, overlays. User actions change the workspace.
void draw_panels(const Context& ui);

void menu_bar(const Context& ui);
/// A menu line that runs a command, by its label or another name. True if chosen.
bool menu_item(const Context& ui, const workspace::Command& command, std::string_view called = "");
void context_menu(const Context& ui);  ///< at the right click
void tool_strip(const Context& ui);    ///< in the view
void command_palette(const Context& ui);
void key_list(const Context& ui);  ///< all commands and their keys, editable
/// The keymap choice at the first start, at the bottom of the view like other offers.
float key_question(const Context& ui, float bottom);
void column_edges(const Context& ui);  ///< column borders to drag, and tabs to fold

void panel_model(const Context& ui);
void panel_cage(const Context& ui);
void panel_select(const Context& ui);  ///< selection tools and selection sets
void panel_making(const Context& ui);  ///< cage generation, in the cage's section
void panel_transform(const Context& ui);
void panel_probes(const Context& ui);
void panel_poses(const Context& ui);                              ///< named poses and their weights
void timeline_panel(const Context& ui);                           ///< below the view
void timeline_track(const Context& ui, ImVec2 low, ImVec2 high);  ///< part of it: ruler, keys and playhead
void panel_checks(const Context& ui);
void panel_method(const Context& ui);
void panel_timings(const Context& ui);
void panel_deformer(const Context& ui);
void panel_custom(const Context& ui);  ///< the parts of a deformer, combined freely
void panel_map(const Context& ui);
void panel_views(const Context& ui);
void panel_vertex(const Context& ui);    ///< the vertex inspector
void vertex_overlay(const Context& ui);  ///< its terms, in the view
void split_overlay(const Context& ui);
void panel_display(const Context& ui);
void status_bar(const Context& ui);
void file_panel(const Context& ui);
void question_panel(const Context& ui);        ///< see scene/workspace/question.h
void message_log(const Context& ui);           ///< all messages
void toasts(const Context& ui, float bottom);  ///< recent messages, above `bottom`
/// At the bottom of the view; return their top edge, or `bottom` if hidden.
float cage_offer(const Context& ui,
                 float bottom);  ///< the next step: get a cage, or fix model parts outside it
bool offers_next_step(const workspace::Workspace& workspace);
/// The available width for notices in the middle of the view, next to the tools.
float notice_room(const Context& ui);
float work_bar(const Context& ui,
               float bottom);              ///< running work, its progress, and Cancel
void notice_bar(const Context& ui);        ///< recoverable unsaved work
void transform_fields(const Context& ui);  ///< part of the cage's or the probes' panel
void hand_overlay(const Context& ui);      ///< partners, radius and pivot in the view
void probe_overlay(const Context& ui);
void gizmo_overlay(const Context& ui);
void axis_overlay(const Context& ui);
void torn_overlay(const Context& ui);               ///< edges where the mesh may fold, see pose_notes()
float map_legend(const Context& ui, float bottom);  ///< colours of the mesh
document::SelectMode select_mode();                 ///< from Shift and Ctrl
void select_overlay(const Context& ui);             ///< box, lasso and brush
std::string select_hint(const workspace::Workspace& workspace);  ///< mouse help for them; empty: none
std::string mouse_text(const workspace::Workspace& workspace);   ///< current mouse actions, in phrases
void view_overlay(const Context& ui);                            ///< box selection, first-start hints

}  // namespace viete::ui
