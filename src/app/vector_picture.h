// A picture whose cage is made of lines, sharp at any size: SVG.
#pragma once

#include <string>

#include "app/viewer.h"

namespace viete::app {

/// The view as an image without its cage, and over it the cage's edges, as far as the model hides them
/// fainter, and its vertices; `width` of lines in logical pixels, of which 96 are an inch.
std::string svg_of(Viewer& viewer, float width);

}  // namespace viete::app
