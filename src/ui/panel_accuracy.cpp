#include <algorithm>

#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

const scene::MethodSample& running(const scene::Workspace& w) {
  const auto& methods = scene::compared_methods;
  const auto at = std::find(methods.begin(), methods.end(), w.document.method);
  return w.methods.samples[static_cast<std::size_t>(at - methods.begin()) % methods.size()];
}

}  // namespace

void panel_accuracy(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  if (!w.document.has_cage()) return;
  const bool used = w.document.scheme.exponential(), measured = used && w.methods.matrices > 0;
  const bool open = section(ui, "Accuracy", false);
  section_note(ui, !used ? "not used" : measured ? "worst " + error(running(w).worst_error) : "");
  if (!open) return;
  if (!used) return note(ui, "This way of blending takes no exponential.");
  if (measured) {
    value_row(ui, "Worst error", error(running(w).worst_error));
    value_row(ui, "Median error", error(running(w).median_error));
    note(ui, "Of exp by " + method_label(w.document.method) + ", relative, on " + count(w.methods.matrices) +
                 " matrices of this frame, against 106 bits");
  }
  command_toggle(ui, "toggle_error_map", w.view.error_map);
}

}  // namespace viete::ui
