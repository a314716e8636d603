// Opens files in the background, so that the view stays responsive: reads them, and binds the model to its
// cage.
#pragma once

#include <limits>
#include <optional>

#include "app/bound.h"
#include "app/model_layer.h"
#include "base/background.h"
#include "scene/files/open.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

struct Loaded {
  scene::Opened opened;
  ModelShading shading;                       ///< looks of a new model
  Bound bound;                                ///< binding of a new model or cage
  std::optional<scene::Question> question{};  ///< if nothing was opened: how to proceed
  scene::OpenRequest request{};               ///< if nothing was opened: the request
};
using Loader = base::BackgroundJob<Loaded>;

/// moving: see shading_of(). Replaces a running request. A document is delivered only together with its
/// binding, so that failures leave the open document unchanged.
void start_loading(Loader& loader, const scene::OpenRequest& request, const scene::Document& current,
                   std::size_t moving = std::numeric_limits<std::size_t>::max());

}  // namespace viete::app
