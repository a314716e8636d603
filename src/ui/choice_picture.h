// The tooltip of a chooser's entry: its sentence, a picture of what it does, and what follows from it.
#pragma once

#include <string>

#include "scene/pictures/choice_picture.h"
#include "ui/context.h"
#include "ui/widgets.h"

namespace viete::ui {

/// Beside the window or list that the last item is in, so that it covers none of the other entries.
void picture_hint(const Context& ui, const scene::ChoicePicture& picture, const std::string& sentence,
                  const std::string& more = "");

/// Of the last item, while the cursor is over it: only then its picture is made.
template <class Choice>
void choice_hint(const Context& ui, Choice choice, const std::string& more = "") {
  if (wants_hint())
    picture_hint(ui, ui.workspace.choice_pictures.of(choice), std::string(scene::entry(choice).sentence),
                 more);
}

}  // namespace viete::ui
