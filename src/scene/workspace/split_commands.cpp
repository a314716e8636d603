// Commands of the view that is split in several.
#include "scene/workspace/command_conditions.h"
#include "scene/workspace/command_tables.h"
#include "scene/workspace/splitting.h"

namespace viete::scene {

namespace {

constexpr Condition is_split{[](const Workspace& w) { return w.split.on(); }, "Split the view in two first."};
constexpr Condition in_two{[](const Workspace& w) { return w.split.sides.size() == 1; },
                           "Split the view in two first."};

}  // namespace

void add_split_commands(CommandTable& table) {
  table.heading("Views");
  constexpr const char* labels[] = {"One", "Two", "Three", "Four"};
  for (std::size_t count = 1; count <= Split::most_sides + 1; ++count) {
    const bool one = count == 1;
    table.choice(
        "views_" + std::to_string(count), "Views", labels[count - 1],
        one ? "The view is whole."
            : "Show the model in several ways at once, each blended, computed and coloured in its own.",
        has_model, [count](Workspace& w) {
          split_view(w, count);
          frame_all(w, true);
        });
  }
  table.add("toggle_wipe", {"Wipe between two views", "Wipe"},
            "Two views in one place, on either side of a line that can be dragged.", in_two,
            {[](Workspace& w) {
               w.split.wipe = !w.split.wipe;
               frame_all(w, true);
             },
             [](const Workspace& w) { return w.split.wipes(); }});
  table.add("toggle_linked_cameras", {"Link the cameras of the views", "Linked cameras"},
            "All views are seen by one camera, or each by its own.", is_split,
            {[](Workspace& w) { w.split.linked = !w.split.linked; },
             [](const Workspace& w) { return w.split.linked; }});
}

}  // namespace viete::scene
