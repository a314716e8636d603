// Lengths, area and volume of the posed model, and how they have changed.
#include <cmath>

#include "scene/workspace/measures.h"
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

void row(const Context& ui, const char* label, double now, double rest, int power) {
  const scene::LengthUnit unit = ui.workspace.document.model.unit;
  value_row(ui, label, measured(now, unit, power) + "  " + change(now, rest));
}

void units(const Context& ui) {
  note(ui, "Unit of the file");
  command_choice(ui, {"unit_none", "unit_mm", "unit_cm", "unit_m", "unit_in", "unit_ft"},
                 static_cast<std::size_t>(ui.workspace.document.model.unit));
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
  row(ui, "Length", between(w.posed), between({}), 1);
}

}  // namespace

void panel_measures(const Context& ui) {
  scene::Workspace& w = ui.workspace;
  const auto& model = w.document.model;
  if (!section(ui, "Measures", false) || !model.surface) return;
  const scene::Measures& now = scene::measure(w.document, w.posed, w.measures);
  row(ui, "Area", now.area, model.summary.area, 2);
  if (model.summary.closed()) row(ui, "Volume", now.volume, model.summary.volume, 3);
  marks(ui);
  command_row(ui, {"mark_point", "clear_marks"});
  units(ui);
}

}  // namespace viete::ui
