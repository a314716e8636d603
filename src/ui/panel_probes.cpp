#include <algorithm>
#include <cmath>

#include "document/probes.h"
#include "interact/cursor_projection.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command_tables.h"

namespace viete::ui {

namespace {

constexpr float probe_label = 86;

void influence(const Context& ui, const char* label, const char* name, document::Part part) {
  document::Document& document = ui.workspace.document;
  document::Influence shown = document.probes().all[document.selection().indices().front()].*part;
  row_label(label, probe_label);
  const std::string prefix = std::string("probe_") + name;
  constexpr float falloff_width = 92;
  ImGui::SetNextItemWidth(falloff_width);
  const auto falloff = entry_list(ui, prefix, std::optional(shown.falloff));
  ImGui::SameLine();
  const double unit = 0.01 * document.space().diagonal(), least = document::least_probe_radius(document),
               most = document::largest_probe_radius(document);
  const bool used = shown.falloff != document::Falloff::none;
  constexpr float value_width = 44;
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  ImGui::BeginDisabled(!used);
  const auto percent = slider(ui, prefix + "_radius", shown.radius / unit,
                              {.least = least / unit,
                               .most = most / unit,
                               .tip = "Radius of influence at rest, in percent of the model's diagonal. The "
                                      "circle in the view shows the largest of the three radii.",
                               .logarithmic = true,
                               .rounded = std::round,
                               .enabled = used},
                              -value_width);
  value_beside(right, std::to_string(std::lround(shown.radius / unit)) + " %");
  ImGui::EndDisabled();
  if (falloff) document::set_falloff(document, part, *falloff);
  if (percent) document::set_radius(document, part, std::clamp(unit * *percent, least, most));
}

void freedom(const Context& ui) {
  double& value = ui.workspace.view.handling.freedom;
  const auto percent = slider_row(ui, "Freedom", probe_label, "pin_freedom", 100 * value,
                                  std::to_string(std::lround(100 * value)) + " %",
                                  {.least = 0,
                                   .most = 100,
                                   .tip = "Allowed deviation from the shapes in the pose list. At 0 %, pins "
                                          "only blend the shapes. At 100 %, "
                                          "the model deforms as rigidly as possible.",
                                   .rounded = std::round});
  if (percent) value = 0.01 * *percent;
}

void mix(const Context& ui) {
  document::Document& document = ui.workspace.document;
  row_label("Combine", probe_label);
  ImGui::SetNextItemWidth(-1);
  const auto chosen = entry_list(ui, "probe_mix", std::optional(document.probes().mix));
  if (chosen) document::set_mix(document, *chosen);
}

}  // namespace

void panel_probes(const Context& ui) {
  const document::Document& document = ui.workspace.document;
  const std::size_t probes = document.probes().all.size();
  if (probes == 0) return;
  const bool open = section(ui, "Probes", false);
  section_note(ui, count(probes));
  if (!open) return;
  command_row(ui, {"mirror_probe", "remove_probe"});
  const bool selected = workspace::selects_probes(ui.workspace) && !document.selection().empty();
  if (document::has_pins(document)) freedom(ui);
  if (selected && workspace::has_pins_selected(ui.workspace)) {
    command_toggle(ui, "toggle_pulls");
  } else if (selected) {
    influence(ui, "Rotation", "turn", &document::Probe::turn);
    influence(ui, "Stretch", "stretch", &document::Probe::stretch);
    influence(ui, "Translation", "move", &document::Probe::move);
  } else {
    note(ui, workspace::selects_probes(ui.workspace)
                 ? "Click a probe in the view to select it."
                 : "Choose \"Select probes\" and click a probe in the view.");
  }
  if (!std::ranges::all_of(document.probes().all, [](const document::Probe& p) { return p.pin.has_value(); }))
    mix(ui);
  if (!selected) return;
  command_row(ui, {"reset_selected"});
  const auto& indices = document.selection().indices();
  const bool locked = std::ranges::all_of(indices, [&](auto i) { return document.probes().all[i].locked; });
  command_toggle(ui, "toggle_locked", locked);
}

namespace {

constexpr float axis_length = 22, dot = 5;  // logical pixels

struct Shown {
  bool selected, hovered, locked;
};

// Draws the axes rotated and stretched like the probe, with screen lengths limited for legibility.
void axes(const Context& ui, OverlayPainter& painter, const interact::CursorProjection& at,
          const glm::dvec3& center, const document::ProbePose& pose, float opacity) {
  const auto& w = ui.workspace;
  const auto m = document::linear_part(pose);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const glm::dvec3 column(m[axis], m[3 + axis], m[6 + axis]);
    const double length = glm::length(column);
    const glm::dvec3 along =
        double(axis_length) * at.per_pixel() * std::clamp(length, 0.4, 2.0) / length * column;
    const interact::CursorProjection end(center + along, w.view.camera);
    painter.line(glm::vec2(at.at()), glm::vec2(end.at()), ui.colors.axis[axis], 2.25f, opacity);
  }
}

// Draws a ring at the pin's target and a line from the pinned vertex. The ring of an exact pin is filled.
void pin(const Context& ui, OverlayPainter& painter, std::size_t i, glm::vec2 middle, const Shown& shown) {
  const auto& w = ui.workspace;
  const document::Probe& probe = w.document.probes().all[i];
  const ImU32 color = shown.selected ? ui.colors.highlight : ui.colors.accent;
  const glm::dvec3 vertex(w.document.space().to_view(document::pinned_vertex(w.document, i)));
  const interact::CursorProjection at(vertex, w.view.camera);
  painter.line(glm::vec2(at.at()), middle, color, 1.5f, 0.8f);
  if (!probe.pin->pulls) painter.disc(middle, dot - 1, color, 1);
  painter.circle(middle, dot + 2, color, 2);
  if (shown.hovered) painter.circle(middle, dot + 6, ui.colors.highlight, 1.5f);
}

void frame(const Context& ui, OverlayPainter& painter, std::size_t i, const Shown& shown) {
  const auto& w = ui.workspace;
  const document::Probe& probe = w.document.probes().all[i];
  const glm::dvec3 center(w.document.space().to_view(document::probe_center(w.document, i)));
  if (!(w.view.camera.depth(glm::vec3(center)) > 0)) return;
  const interact::CursorProjection at(center, w.view.camera);
  const glm::vec2 middle(at.at());
  const float opacity = shown.selected || shown.hovered ? 1.0f : 0.75f;
  if (probe.pin) return pin(ui, painter, i, middle, shown);
  if (shown.selected && !workspace::shows_mask(w)) {
    const double radius = std::max({probe.turn.radius, probe.stretch.radius, probe.move.radius});
    const auto pixels = static_cast<float>(radius * w.document.space().scale / at.per_pixel());
    if (pixels < 4000) painter.circle(middle, pixels, ui.colors.highlight, 1.25f, 0.5f);
  }
  axes(ui, painter, at, center, probe.pose, opacity);
  const ImU32 color = shown.selected ? ui.colors.highlight : ui.colors.neutral;
  if (shown.locked) {
    painter.polygon(square(middle, dot), color, opacity);
  } else {
    painter.disc(middle, dot, color, opacity);
  }
  if (shown.hovered) painter.circle(middle, dot + 4, ui.colors.highlight, 1.5f);
}

}  // namespace

void probe_overlay(const Context& ui) {
  const auto& w = ui.workspace;
  if (!w.view.options.cage || w.document.probes().empty()) return;
  OverlayPainter painter(ui);
  const bool chosen = workspace::selects_probes(w);
  for (std::size_t i = 0; i < w.document.probes().all.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    frame(ui, painter, i,
          {chosen && w.document.selection().contains(index), chosen && w.view.interaction.hovered == index,
           w.document.probes().all[i].locked});
  }
}

}  // namespace viete::ui
