// Commands of the maps: fields as colours on the mesh.
#include <algorithm>

#include "scene/document/brush.h"
#include "scene/workspace/choice_commands.h"
#include "scene/workspace/command_conditions.h"
#include "scene/workspace/command_tables.h"

namespace viete::scene {

namespace {

using lab::Field;

constexpr Condition has_map{[](const Workspace& w) { return w.field.values != nullptr; },
                            "Choose a map first (Analysis, Map)."};

constexpr Condition has_vertex{[](const Workspace& w) { return w.vertex.vertex.has_value(); },
                               "Pick a vertex first."};

void pick_vertex(Workspace& w) {
  const auto vertex = pointed_vertex(w, w.interaction.cursor.value_or(w.viewport.middle()));
  if (!vertex) return w.messages.info("Point at the model to pick a vertex of it.");
  show_sum_at(w, vertex);
}

void choose_field(Workspace& w, Field field) {
  w.view.field = field;
}

}  // namespace

void show_sum_at(Workspace& w, std::optional<std::uint32_t> vertex) {
  w.vertex.vertex = vertex;
  w.vertex.appearing = true;
  PanelLayout& layout = w.remembered.layout;
  for (const char* section : {"Analysis", "Vertex inspector"}) layout.sections[section] = true;
  if (shown_columns(layout, w.viewport.window.x).methods <= 0)
    toggle_column(layout, Column::methods, w.viewport.window.x);
}

std::optional<std::uint32_t> pointed_vertex(const Workspace& w, const glm::vec2& at) {
  const auto hit = pick_triangle(w.document, w.posed, w.camera.ray(at, w.viewport));
  if (!hit) return std::nullopt;
  const auto nearest = std::ranges::max_element(hit->shares) - hit->shares.begin();
  return w.document.model.surface->triangles[hit->triangle][static_cast<std::size_t>(nearest)];
}

void add_map_commands(CommandTable& table) {
  table.heading("Map");
  add_choices<Field>(table, "Map", has_model, choose_field);
  table.add("next_map", "Next map", "Colour the mesh by the next of the maps.", has_model,
            [](Workspace& w) { w.view.field = next_choice(w.view.field); });
  table.add("toggle_error_map", {"Show errors on the mesh", "Error on the mesh"},
            "Colour the mesh by the relative error of the exponential at each vertex.",
            {key('E'), false, true}, uses_method,
            {[](Workspace& w) {
               const bool on = w.view.field == Field::exp_error;
               w.view.field = on ? Field::none : Field::exp_error;
             },
             [](const Workspace& w) { return w.view.field == Field::exp_error; }});
  table.add("hold_map_range", "Hold the range",
            "The colours keep the range that they have now, whatever the hand does.", has_map,
            {[](Workspace& w) { w.field.holds_range = !w.field.holds_range; },
             [](const Workspace& w) { return w.field.holds_range; }});
  table.add("frame_worst", "Frame the worst vertex", "See the vertex where the map says most, from near.",
            has_map, frame_worst);
  table.add(
      "pick_vertex", {"Pick a vertex to see its sum", "Pick"},
      "Show what is summed at the vertex under the cursor: weights, maps, and how each method takes the "
      "exponential.",
      {key('Y'), false, false, true}, has_model, pick_vertex);
  table.add("pick_worst", {"Pick the worst vertex of the map", "The worst of the map"},
            "Show what is summed at the vertex where the map says most.", has_map,
            [](Workspace& w) { show_sum_at(w, w.field.stats.worst); });
  table.add("drop_vertex", {"Close the sum at a vertex", "Close"}, "Show no vertex's sum.", has_vertex,
            [](Workspace& w) { w.vertex.vertex.reset(); });
}

}  // namespace viete::scene
