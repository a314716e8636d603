// Opens files in the background, so that the view stays responsive: reads them, and binds the model to its
// cage.
#pragma once

#include <optional>

#include "app/bound.h"
#include "app/model_layer.h"
#include "base/background.h"
#include "files/open.h"
#include "workspace/workspace.h"

namespace viete::app {

struct Loaded {
  files::Opened opened;
  ModelShading shading;                           ///< looks of a new model
  Bound bound;                                    ///< binding of a new model or cage
  std::optional<workspace::Question> question{};  ///< if nothing was opened: how to proceed
  files::OpenRequest request{};                   ///< if nothing was opened: the request
};
using Loader = base::BackgroundJob<Loaded>;

/// Replaces a running request. A document is delivered only together with its binding, so that failures leave
/// the open document unchanged.
void start_loading(Loader& loader, const files::OpenRequest& request, const document::Document& current);

}  // namespace viete::app
