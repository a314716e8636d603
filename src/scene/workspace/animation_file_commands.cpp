#include "scene/workspace/animation_file_commands.h"

#include "scene/workspace/command_conditions.h"
#include "scene/workspace/file_commands.h"

namespace viete::scene {

namespace {

constexpr Condition can_import{
    [](const Workspace& w) { return has_cage(w) && !is_editing_cage(w.document) && !in_hand(w); },
    "Open a cage first, and pose it rather than edit it (Tab)."};
constexpr Condition can_export_animation{[](const Workspace& w) {
                                           return is_movable(w) && !w.document.timeline.keys.empty() &&
                                                  !is_editing_cage(w.document);
                                         },
                                         "There are no keys: pose the cage and set one (I)."};

}  // namespace

std::vector<Command> animation_file_commands() {
  return {
      {"import_poses",
       "Import poses",
       "Add posed cages to the list of poses: a file, one with morph targets, or all of a folder.",
       "Poses",
       {},
       {},
       can_import,
       browse_for_poses},
      {"import_animation",
       "Import animation",
       "Take keys from numbered posed cages, a point cache of the cage (PC2, MDD), or its animated morph "
       "targets (glTF).",
       "Time",
       {},
       {},
       can_import,
       browse_for_animation},
      {"save_animation",
       "Export animation",
       "Write the frames that play: a point cache (PC2, MDD), glTF with morph targets, or numbered models.",
       "Time",
       {},
       {},
       can_export_animation,
       browse_to_save_animation},
  };
}

}  // namespace viete::scene
