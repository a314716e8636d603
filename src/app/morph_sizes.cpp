#include "app/morph_sizes.h"

#include <utility>

#include "base/text.h"

namespace viete::app {

void MorphSizes::follow(scene::Workspace& w) {
  scene::FileBrowser& browser = w.browser;
  const bool asks =
      browser.open && browser.makes_morphs() && w.document.is_movable() && !w.document.timeline.keys.empty();
  if (!asks) {
    asked_.reset();
    return job_.cancel();
  }
  const Asked now{browser.morphs, scene::format_of(browser)};
  if (asked_ != now) {
    asked_ = now;
    browser.morph_size.clear();
    scene::AnimationExport what = scene::animation_export_of(w.document, scene::chosen_file(browser));
    what.tolerance = browser.morphs.tolerance;
    what.normals = browser.morphs.normals;
    job_.start([what = std::move(what)](base::Progress& progress) {
      return scene::estimate_morphs(what, &progress);
    });
  }
  const auto result = job_.poll();
  if (!result) return;
  browser.morph_size = result->value ? base::counted(result->value->targets, "morph target") + ", about " +
                                           base::memory_size(result->value->bytes) + " beside the model"
                                     : result->problem;
}

}  // namespace viete::app
