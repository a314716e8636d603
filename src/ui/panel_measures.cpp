// Lengths, area and volume of the posed model, and how they have changed.
#include <cmath>

#include "scene/measures.h"
#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

std::string change(double now, double rest) {
  if (!(std::abs(rest) > 0)) return "";
  char text[32];
  const double percent = 100 * (now / rest - 1);
  std::snprintf(text, sizeof text, "%+.2f %%", std::abs(percent) < 0.005 ? 0.0 : percent);
  return text;
}

void row(const Context& ui, const char* label, double now, double rest) {
  value_row(ui, label, measured(now) + "  " + change(now, rest));
}

void marks(const Context& ui) {
  const auto& w = ui.workspace;
  if (w.marks.size() < 2)
    return note(ui, w.marks.empty() ? "Point at the model and press Y, twice, to measure a length."
                                    : "Point at another place and press Y.");
  const auto between = [&](const scene::PosedModel& posed) {
    const auto a = scene::place_of(w.document, posed, w.marks[0]),
               b = scene::place_of(w.document, posed, w.marks[1]);
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  };
  row(ui, "Length", between(w.posed), between({}));
}

}  // namespace

void panel_measures(const Context& ui) {
  scene::Workspace& w = ui.workspace;
  const auto& model = w.document.model;
  if (!section(ui, "Measures", false) || !model.surface) return;
  const scene::Measures& now = scene::measure(w.document, w.posed, w.measures);
  row(ui, "Area", now.area, model.summary.area);
  if (model.summary.closed()) row(ui, "Volume", now.volume, model.summary.volume);
  marks(ui);
  command_row(ui, {"mark_point", "clear_marks"});
}

}  // namespace viete::ui
