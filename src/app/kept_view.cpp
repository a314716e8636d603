#include "app/kept_view.h"

namespace viete::app {

namespace {

ViewDrawing coarse(ViewDrawing drawing) {
  drawing.size = (drawing.size + 1) / 2;
  drawing.scale /= 2;
  return drawing;
}

}  // namespace

bool KeptView::draw(WorkspaceRenderer& renderer, const ViewDrawing& drawing, Fineness fineness) {
  if (shows(drawing) && fineness_ >= fineness) return false;
  const ViewDrawing now = fineness == Fineness::coarse ? coarse(drawing) : drawing;
  const int samples[] = {0, samples_.plain, samples_.smooth};
  picture_.begin(now.size, samples[static_cast<int>(fineness)]);
  renderer.draw(now);
  picture_.resolve();
  ++count_;
  drawn_ = drawing;
  fineness_ = fineness;
  return true;
}

}  // namespace viete::app
