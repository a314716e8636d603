// What an animation of morph targets would take, found aside while it is being named.
#pragma once

#include <optional>
#include <string>

#include "base/background.h"
#include "scene/files/animation_export.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

class MorphSizes {
public:
  /// Every frame: says it in the file browser, once it is known.
  void follow(scene::Workspace& workspace);
  bool running() const { return job_.running(); }

private:
  struct Asked {
    scene::MorphChoice choice;
    std::string format;
    friend bool operator==(const Asked&, const Asked&) = default;
  };
  std::optional<Asked> asked_;
  base::BackgroundJob<scene::MorphEstimate> job_;
};

}  // namespace viete::app
