// The panels, one function each.
#pragma once

#include <string_view>

#include "ui/context.h"

namespace viete::scene {
struct Command;
}

namespace viete::ui {

/// Everything: columns, status bar, overlays. Returns nothing; what the user does changes the workspace.
void draw_panels(const Context& ui);

void menu_bar(const Context& ui);
/// A line of a menu that is open, for a command by that name. True if it was chosen.
bool menu_item(const Context& ui, const scene::Command& command, std::string_view called);
void context_menu(const Context& ui);  ///< where the right button was clicked
void tool_strip(const Context& ui);    ///< in the view
void command_palette(const Context& ui);
void key_list(const Context& ui);  ///< every command with its keys, to change them
/// Once, at the first start: which program's keys; at the bottom of the view, as other offers are.
float key_question(const Context& ui, float bottom);
void key_prompt(const Context& ui);    ///< which command gets the key that is pressed next
void column_edges(const Context& ui);  ///< to drag, and tabs that fold a column away

void panel_model(const Context& ui);
void panel_cage(const Context& ui);
void panel_select(const Context& ui);  ///< ways to select, and sets by name
void panel_making(const Context& ui);  ///< part of the cage's section: one that is being made
void panel_transform(const Context& ui);
void panel_probes(const Context& ui);
void panel_poses(const Context& ui);     ///< poses with names, and how much of each is mixed in
void timeline_panel(const Context& ui);  ///< below the view
void timeline_track(const Context& ui, ImVec2 low, ImVec2 high);  ///< part of it: ruler, keys and playhead
void panel_checks(const Context& ui);
void panel_method(const Context& ui);
void panel_timings(const Context& ui);
void panel_deformer(const Context& ui);
void panel_custom(const Context& ui);  ///< the parts of a deformer, to combine them freely
void panel_map(const Context& ui);
void panel_views(const Context& ui);
void panel_vertex(const Context& ui);    ///< the sum at a vertex
void vertex_overlay(const Context& ui);  ///< and where its terms come from
void split_overlay(const Context& ui);
/// How much of the background list there was.
struct DrawnBefore {
  int vertices, indices, first;
};
/// What was drawn since then, in the other views too.
void repeat_in_views(const Context& ui, const DrawnBefore& before);
void panel_display(const Context& ui);
void status_bar(const Context& ui);
void help_overlay(const Context& ui);
void file_panel(const Context& ui);
void question_panel(const Context& ui);  ///< what must be answered first, see scene/workspace/question.h
void message_log(const Context& ui);     ///< all that was said
void toasts(const Context& ui, float bottom);  ///< what was said just now, above `bottom`
/// At the bottom of the view; returns where they begin, or `bottom` while they are not shown.
float cage_offer(const Context& ui, float bottom);  ///< the next step: a cage, or what is outside of it
bool offers_next_step(const scene::Workspace& workspace);
/// How wide what stands in the middle of the view may be, beside the tools at its edge.
float notice_room(const Context& ui);
float check_badge(const Context& ui, float bottom);  ///< what the checks found, and what helps
float work_bar(const Context& ui,
               float bottom);              ///< what is being read, bound or written, how far, and Cancel
void notice_bar(const Context& ui);        ///< unsaved work that can be brought back
void transform_fields(const Context& ui);  ///< a part of the cage's panel, or of the probes'
void hand_overlay(const Context& ui);      ///< partners, radius and pivot in the view
void probe_overlay(const Context& ui);
void gizmo_overlay(const Context& ui);
void axis_overlay(const Context& ui);
void torn_overlay(const Context& ui);               ///< where the mesh may fold, see pose_notes()
float map_legend(const Context& ui, float bottom);  ///< of the colours on the mesh
scene::SelectMode select_mode();                    ///< as Shift and Ctrl are held
void select_overlay(const Context& ui);             ///< box, lasso and brush, being drawn or about to be
std::string select_hint(const scene::Workspace& workspace);  ///< what the mouse does with them; empty: none
std::string mouse_text(const scene::Workspace& workspace);   ///< what the mouse would do now, in phrases
void view_overlay(const Context& ui);                        ///< box selection, first-start hints

}  // namespace viete::ui
