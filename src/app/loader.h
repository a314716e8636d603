// Reads files and binds the model to its cage in the background, so that the view stays responsive.
#pragma once

#include <limits>
#include <optional>

#include "app/bound.h"
#include "app/model_layer.h"
#include "base/background.h"
#include "files/open.h"
#include "workspace/workspace.h"

namespace viete::app {

struct Loaded {
  files::Opened opened;
  ModelShading shading;                           ///< empty if the model is unchanged
  Bound bound;                                    ///< the binding of a new model or cage; otherwise empty
  std::optional<workspace::Question> question{};  ///< set if the user must answer before files can be opened
  files::OpenRequest request{};                   ///< if there is a question: the request to repeat
};
using Loader = base::BackgroundJob<Loaded>;

/// Cancels a running request and starts `request`. If reading or binding fails, the open document stays
/// unchanged. See shading_of() for `moving`.
void start_loading(Loader& loader, const files::OpenRequest& request, const document::Document& current,
                   std::size_t moving = std::numeric_limits<std::size_t>::max());

}  // namespace viete::app
