// Commands for the display: panels, shading, maps and split views.
#include <algorithm>
#include <utility>

#include "document/brush.h"
#include "document/elements.h"
#include "workspace/command_tables.h"
#include "workspace/pointer.h"
#include "workspace/workspace.h"

namespace viete::workspace {

namespace {

// Shows or hides a column. If all panels are hidden, shows the panels with this column.
Effect shows(Column column) {
  const auto shown = [column](const Workspace& w) {
    return w.view.options.panels &&
           shown_columns(w.preferences.layout, w.view.camera.viewport.window.x).of(column) > 0;
  };
  const auto toggle = [column, shown](Workspace& w) {
    const bool hidden = !std::exchange(w.view.options.panels, true);
    if (!hidden || !shown(w)) toggle_column(w.preferences.layout, column, w.view.camera.viewport.window.x);
  };
  return {toggle, shown};
}

// Switches between this up axis and Y.
Effect switches_up(document::UpAxis axis) {
  const auto is_up = [axis](const Workspace& w) { return w.view.camera.pose().up == axis; };
  return {[=](Workspace& w) { w.view.camera.set_up(is_up(w) ? document::UpAxis::y : axis); }, is_up};
}

void add_looks(CommandTable& table) {
  using V = document::StandardView;
  const struct {
    const char *name, *where, *brief;
    Shortcut shortcut;
    V view;
  } sides[] = {{"view_front", "from the front", "Front", {Key::pad1}, V::front},
               {"view_back", "from the back", "Back", {Key::pad1, true}, V::back},
               {"view_right", "from the right", "Right", {Key::pad3}, V::right},
               {"view_left", "from the left", "Left", {Key::pad3, true}, V::left},
               {"view_top", "from the top", "Top", {Key::pad7}, V::top},
               {"view_bottom", "from the bottom", "Bottom", {Key::pad7, true}, V::bottom}};
  const auto look = [](V view) {
    return [view](Workspace& w) {
      w.view.camera.look(view);
      frame_all(w, true);
    };
  };
  for (const auto& side : sides) {
    const std::string text = std::string("View ") + side.where;
    table.add(side.name, {text, side.brief}, text + '.', side.shortcut, always, look(side.view))
        .under("Viewpoint");
  }
  table
      .add("view_home", {"Home view", "Home"}, "Show the whole model from the front, right and above.",
           {Key::home}, always, look(V::home))
      .or_by({Key::pad0})
      .under("Viewpoint");
}

constexpr Condition is_split{"Split the view in two first.",
                             [](const Workspace& w) { return w.view.split.on(); }};

constexpr Condition has_map{"Choose a map first (Analysis, Map).",
                            [](const Workspace& w) { return w.view.split.views[0].shown.values != nullptr; }};

constexpr Condition can_shade{"Not available for captures, which have their own colours.",
                              [](const Workspace& w) { return w.document.model().splats == nullptr; }};
constexpr Condition can_show_edges{
    "Not available for captures and points, which have no edges.",
    [](const Workspace& w) { return !has_model(w) || w.document.has_faces(); }};
constexpr Condition has_vertex{"Inspect a vertex first.",
                               [](const Workspace& w) { return w.view.vertex.vertex.has_value(); }};

// Opens the vertex inspector. If the column of the inspector is hidden, shows the column.
void show_sum_at(Workspace& w, std::uint32_t vertex) {
  w.view.vertex.vertex = vertex;
  w.view.vertex.appearing = true;
  PanelLayout& layout = w.preferences.layout;
  for (const char* section : {"Analysis", "Vertex inspector"}) layout.sections[section] = true;
  if (shown_columns(layout, w.view.camera.viewport.window.x).methods <= 0)
    toggle_column(layout, Column::methods, w.view.camera.viewport.window.x);
}

void pick_vertex(Workspace& w) {
  const glm::vec2 at = w.view.interaction.cursor.value_or(w.view.camera.viewport.middle());
  const auto hit = pick_corners(w.document, w.frame.posed, w.view.camera.ray(at));
  if (!hit) return w.messages.info("Point at a vertex of the model first.");
  const auto nearest = std::ranges::max_element(hit->shares) - hit->shares.begin();
  show_sum_at(w, hit->corners[static_cast<std::size_t>(nearest)]);
}

}  // namespace

void add_camera_commands(CommandTable& table) {
  table.heading("View");
  table.add("frame_all", "Frame all", "Show the whole model and cage.", {key('F'), false, true}, has_model,
            [](Workspace& w) { frame_all(w, true); });
  table.add("frame_selection", "Frame selection", "Show the selection, or everything without a selection.",
            {key('F')}, has_model, [](Workspace& w) { frame_selection(w, true); });
  add_looks(table);
  table
      .add("toggle_orthographic", {"Orthographic view", "Orthographic"},
           "Show the scene without perspective.", {Key::pad5}, always,
           {[](Workspace& w) { w.view.camera.set_orthographic(!w.view.camera.pose().orthographic); },
            [](const Workspace& w) { return w.view.camera.pose().orthographic; }})
      .or_by({key('O')});
  table.add("toggle_z_up", "Z up", "Use Z as the up axis. When off, Y is up. Files keep their axes.",
            {key('U')}, always, switches_up(document::UpAxis::z));
  table.add("toggle_y_down", "Y down",
            "Turn the view if the model is upside down, like most captures. Files keep their axes.", always,
            switches_up(document::UpAxis::minus_y));
}

void add_view_commands(CommandTable& table) {
  table.heading("View");
  table.add("toggle_wireframe", {"Show wireframe", "Wireframe"}, "Show the edges of the model.",
            {key('W'), false, true}, can_show_edges, switches(&document::ViewOptions::wireframe));
  add_choices<document::Shading>(table, "Shading", can_shade,
                                 [](Workspace& w, document::Shading s) { w.view.options.shading = s; });
  table.add("next_shading", "Next shading",
            "Switch to the next shading: clay, porcelain, jade, file colours, checker, normals, stripes.",
            {key('V')}, can_shade,
            [](Workspace& w) { w.view.options.shading = next_choice(w.view.options.shading); });
  table.add("toggle_model", {"Show model", "Model"}, "Show the model.", {key('M')}, always,
            switches(&document::ViewOptions::model));
  table.add("toggle_deformed", {"Show deformation", "Deformed"},
            "Show the deformed model. When off, show the model at rest.", {key('N')}, always,
            switches(&document::ViewOptions::deformed));
  table.add("toggle_cage", {"Show cage", "Cage"}, "Show the cage and the probes.", {key('C')}, always,
            switches(&document::ViewOptions::cage));
  table.add("toggle_grid", {"Show grid", "Grid"}, "Show the ground grid.", {key('G')}, always,
            switches(&document::ViewOptions::grid));
  table.add("toggle_axes", {"Show axes", "Axes"}, "Show the axis widget at the top right.", {key('X')},
            always, switches(&document::ViewOptions::axes));
  table.add("toggle_ghost", {"Show rest cage", "Rest cage"},
            "Show the cage at rest faintly behind the posed cage.", {key('H')}, always,
            switches(&document::ViewOptions::ghost));
  table.add("toggle_theme", "Dark theme", "Switch between the dark and the light theme.", {key('T')}, always,
            {[](Workspace& w) { w.preferences.dark = w.view.options.dark = !w.view.options.dark; },
             [](const Workspace& w) { return w.view.options.dark; }});
  table.add("toggle_coarse_motion", "Half resolution in motion",
            "Draw at half resolution while the view changes. Faster with software rendering.", always,
            {[](Workspace& w) { w.preferences.coarse_motion = !draws_coarsely(w); }, draws_coarsely});
  table.add("toggle_panels", {"Show panels", "Panels"}, "Show or hide the panels.", {Key::f2}, always,
            switches(&document::ViewOptions::panels));
  table.add("toggle_full_screen", "Full screen", "Switch between full screen and window.", {Key::f11}, always,
            {[](Workspace& w) { w.view.full_screen = !w.view.full_screen; },
             [](const Workspace& w) { return w.view.full_screen; }});
  table.add("toggle_tools", {"Show tools column", "Tools column"},
            "Show or hide the left column: model, cage, poses and tools.", always, shows(Column::tools));
  table.add("toggle_methods", {"Show methods column", "Methods column"},
            "Show or hide the right column: method, timings, deformer and analysis.", always,
            shows(Column::methods));
}

void add_help_commands(CommandTable& table) {
  table.heading("Help");
  table.add("help", {"Show keys and mouse", "Keys"}, "Show all keys and mouse actions, and change keys.",
            {Key::f1}, always, [](Workspace& w) {
              w.panels.key_list = {!w.panels.key_list.open, true, "", false, {}};
            });
  table
      .add("command_palette", {"Find command", "Commands"}, "Find a command by its name and run it.",
           {key('K'), true}, always,
           [](Workspace& w) {
             w.panels.palette = {!w.panels.palette.open, true, "", 0};
           })
      .or_by({Key::f3});
  table.add("show_messages", {"Show messages", "Messages"},
            "Show all messages since the start of the program.", always,
            [](Workspace& w) { w.panels.show_messages = !w.panels.show_messages; });
  table.add("manual", {"Open manual", "Manual"}, "Open the manual in the browser.", always,
            [](Workspace& w) { w.jobs.wishes.add(ShowManual{}); });
  table.add("first_steps", "First steps", "Open the manual's chapter about the window.", always,
            [](Workspace& w) { w.jobs.wishes.add(ShowManual{"window"}); });
}

void add_map_commands(CommandTable& table) {
  table.heading("Map");
  add_choices<analysis::Field>(table, "Map", has_model,
                               [](Workspace& w, analysis::Field f) { w.view.options.field = f; });
  table.add("hold_map_range", "Lock range", "Keep the current colour range while the model changes.", has_map,
            {[](Workspace& w) { w.view.split.views[0].shown.holds_range ^= true; },
             [](const Workspace& w) { return w.view.split.views[0].shown.holds_range; }});
  table.add("frame_worst", "Zoom to largest value", "Zoom to the vertex with the largest value of the map.",
            has_map, frame_worst);
  table.add("pick_vertex", {"Inspect vertex", "Inspect"},
            "Show weights, matrices and the result of each method for the vertex under the pointer.",
            {key('Y'), false, false, true}, has_model, pick_vertex);
  table.add("pick_worst", {"Inspect largest value", "Largest value"},
            "Open the vertex inspector for the vertex with the largest value of the map.", has_map,
            [](Workspace& w) { show_sum_at(w, w.view.split.views[0].shown.stats.worst); });
  table.add("drop_vertex", {"Close vertex inspector", "Close"}, "Close the vertex inspector.", has_vertex,
            [](Workspace& w) { w.view.vertex.vertex.reset(); });
}

void add_split_commands(CommandTable& table) {
  table.heading("Views");
  constexpr const char* labels[] = {"One", "Two", "Three", "Four"};
  for (std::size_t count = 1; count <= Split::most; ++count) {
    const bool one = count == 1;
    table.choice(
        "views_" + std::to_string(count), "Views", labels[count - 1],
        one ? "Show a single view." : "Split the view to compare deformers, methods and maps side by side.",
        has_model, [count](Workspace& w) {
          split_view(w, count);
          frame_all(w, true);
        });
  }
  table.add("toggle_linked_cameras", {"Link cameras", "Linked cameras"},
            "Use one camera for all views. When off, each view has its own camera.", is_split,
            {[](Workspace& w) { w.view.split.linked = !w.view.split.linked; },
             [](const Workspace& w) { return w.view.split.linked; }});
}

}  // namespace viete::workspace
