// Commands of the Lab's maps: fields as colours on the mesh.
#include "scene/workspace/choice_commands.h"
#include "scene/workspace/command_conditions.h"
#include "scene/workspace/command_tables.h"

namespace viete::scene {

namespace {

using lab::Field;

constexpr Condition has_map{[](const Workspace& w) { return w.field.values != nullptr; },
                            "Choose a map of the Lab first."};

void choose_field(Workspace& w, Field field) {
  w.view.field = field;
}

}  // namespace

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
}

}  // namespace viete::scene
