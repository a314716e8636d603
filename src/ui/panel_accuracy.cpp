#include <algorithm>
#include <cstdio>

#include "scene/document/edit.h"
#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

// How far drawn vertices are from those of the same frame in double.
std::string picture_error(const scene::Workspace& w) {
  if (w.fused_error > 0) {
    char text[32];
    std::snprintf(text, sizeof text, "%.0e of the size", w.fused_error);
    return text;
  }
  return scene::shows_links(w) ? "none: in double" : "-";
}

void picture_row(const Context& ui) {
  value_row(ui, "Picture", picture_error(ui.workspace));
  hint(
      "Rounding of the whole frame: the largest distance of sampled vertices, as they are drawn, from the "
      "same "
      "frame in double, in diagonals of the cage. Far below a pixel it is not seen; exports are always in "
      "double.");
}

}  // namespace

void panel_accuracy(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  if (!w.document.has_cage()) return;
  const bool used = w.document.scheme.exponential(), rest = !scene::differs_from_rest(w.document);
  const scene::MethodSample* measured = running_sample(w);
  const bool open = section(ui, "Accuracy");
  section_note(ui, measured ? "worst " + error(measured->worst_error) : used && rest ? "at rest" : "");
  if (!open) return;
  picture_row(ui);
  const auto exponential = [&](const char* label, double value) {
    value_row(ui, label, !used ? "not used" : measured ? error(value) : rest ? "at rest" : "-");
    hint(
        "Of the exponential alone: the relative error, in the Frobenius norm, of exp of the symmetric "
        "matrices of "
        "this frame, against a reference of 106 bits.");
  };
  exponential("Exponential, worst", measured ? measured->worst_error : 0);
  exponential("Exponential, median", measured ? measured->median_error : 0);
  note_within(ui, 2,
              !used      ? "This way of blending takes no exponential."
              : measured ? "Of exp by " + method_label(w.document.method) + ", on " +
                               count(w.methods.matrices) + " matrices of this frame"
                         : " ");
  command_toggle(ui, "toggle_error_map");
}

}  // namespace viete::ui
