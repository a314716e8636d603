// Marks on the model, and the length between two of them; and marks at the cage where the mesh may fold.
#include <vector>

#include "scene/document/pose_notes.h"
#include "scene/hand/picking.h"
#include "scene/hand/projector.h"
#include "scene/workspace/measures.h"
#include "ui/format.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"

namespace viete::ui {

void torn_overlay(const Context& ui) {
  const auto& w = ui.workspace;
  if (!w.view.cage || !w.document.has_cage()) return;
  constexpr std::size_t most = 200;
  const auto& positions = w.document.pose.positions;
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  OverlayPainter paint(ui);
  for (const auto& [a, b] : scene::torn_edges(w.pose_report, *w.document.cage, most)) {
    const auto from = project(positions[a]), to = project(positions[b]);
    if (from && to) paint.line(glm::vec2(*from), glm::vec2(*to), ui.colors.bad, 2.5f);
  }
}

void mark_overlay(const Context& ui) {
  const auto& w = ui.workspace;
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  std::vector<glm::dvec3> places;
  std::vector<ImVec2> shown;
  for (const auto& mark : w.marks) {
    const auto place = scene::place_of(w.document, w.posed, mark);
    places.emplace_back(place[0], place[1], place[2]);
    if (const auto at = project(place)) shown.push_back({at->x, at->y});
  }
  const auto line = [&](float width, ImU32 color) {
    if (shown.size() == 2) draw.AddLine(shown[0], shown[1], color, width);
    for (const ImVec2& at : shown) draw.AddCircleFilled(at, 2 + width, color);
  };
  line(3.5f, faded(ui.colors.halo, 1.0f));
  line(1.5f, ui.colors.text);
  if (shown.size() < 2) return;
  const double length = glm::distance(places[0], places[1]);
  const std::string text = measured(length, w.document.model.unit);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at{0.5f * (shown[0].x + shown[1].x - size.x), 0.5f * (shown[0].y + shown[1].y) - size.y - 8};
  draw.AddRectFilled({at.x - 5, at.y - 2}, {at.x + size.x + 5, at.y + size.y + 2},
                     faded(ui.colors.halo, 0.9f), 4);
  draw.AddText(at, ui.colors.text, text.c_str());
}

}  // namespace viete::ui
