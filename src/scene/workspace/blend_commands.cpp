#include "scene/document/edit.h"
#include "scene/workspace/choice_commands.h"
#include "scene/workspace/command_conditions.h"
#include "scene/workspace/command_tables.h"

namespace viete::scene {

namespace {

// A way, or one of the choices that ways are made of.
template <class Entry>
void add_table(CommandTable& table, std::span<const Entry> entries, std::string_view headline) {
  for (const Entry& entry : entries)
    table.choice(choice_command_name(entry.value), headline, entry.label, entry.sentence, hand_is_free,
                 [value = entry.value](Workspace& w) {
                   set_scheme(w.document, deform::chosen(value, w.document.scheme));
                 });
}

void add_methods(CommandTable& table) {
  char digit = '1';
  for (const auto& entry : sym3::methods())
    table.add(std::string("method_") + entry.name, {std::string("Method: ") + entry.label, entry.label},
              entry.sentence, {key(digit++), false, true}, uses_method,
              [method = entry.method](Workspace& w) { w.document.put_method(method); });
}

}  // namespace

void add_blend_commands(CommandTable& table) {
  table.heading("Method");
  add_methods(table);
  table.heading("Blend");
  add_table(table, deform::all_ways(), "Deformer");
  add_table(table, deform::all_weights(), "Weights");
  add_table(table, deform::all_blends(), "Blend");
  table.add("toggle_stitched", {"Stitch the model (ARAP)", "Stitched (ARAP)"},
            "As rigid as possible: the triangles of the model follow the blended maps, and its vertices are "
            "solved for. Details keep their shape; a frame takes longer.",
            with_free_hand<has_maps>,
            {[](Workspace& w) { set_iterations(w.document, w.document.scheme.stitched() ? 0 : 1); },
             [](const Workspace& w) { return w.document.scheme.stitched(); }});
  table.heading("Method");
  table.add(
      "toggle_same_path", "Same engine for all (staged, double)",
      "Run Fast stage by stage in double precision, as the other methods. Otherwise its frame is one pass in "
      "single precision.",
      uses_method, switches(&ViewOptions::same_path));
  table.add("show_report", {"Make a report", "Make a report"},
            "Measure the figures of the paper on the dragon, which takes half a minute, and open them in the "
            "browser.",
            is_not_reporting, [](Workspace& w) { w.requests.show_report = true; });
  table.add("stop_report", {"Cancel the report", "Cancel"}, "Stop measuring.", is_reporting,
            passing([](Workspace& w) { w.requests.stop_report = true; }));
}

}  // namespace viete::scene
