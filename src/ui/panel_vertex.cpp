#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "interact/cursor_projection.h"
#include "ui/format.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

using workspace::VertexView;

constexpr std::size_t most_bars = 8;

std::string weight_text(double share) {
  return formatted("%.1f %%", 100 * share);
}

// The total weight of the terms that have no bar.
double rest_of(const VertexView& view) {
  double rest = 0;
  for (std::size_t i = most_bars; i < view.terms.size(); ++i) rest += view.terms[i].weight;
  return rest;
}

void bar(const Context& ui, const std::string& name, double weight, double largest) {
  constexpr float label = 82, value = 56, height = 18;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float right = at.x + ImGui::GetContentRegionAvail().x, room = right - value - at.x - label;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddText(at, ui.colors.faint, name.c_str());
  const float wide = std::min(static_cast<float>(std::abs(weight) / largest), 1.0f) * room;
  draw.AddRectFilled({at.x + label, at.y + 4}, {at.x + label + std::max(1.0f, wide), at.y + height - 3},
                     weight < 0 ? ui.colors.warn : ui.colors.accent, 2);
  ImGui::PushFont(ui.fonts.numbers);
  const std::string text = weight_text(weight);
  draw.AddText({right - ImGui::CalcTextSize(text.c_str()).x, at.y + 1}, ui.colors.text, text.c_str());
  ImGui::PopFont();
  ImGui::Dummy({room, height});
}

void weights(const Context& ui, const VertexView& view) {
  const double largest = std::abs(view.terms.front().weight);
  for (std::size_t i = 0; i < std::min(most_bars, view.terms.size()); ++i)
    bar(ui, "element " + std::to_string(view.terms[i].element), view.terms[i].weight, largest);
  if (view.terms.size() > most_bars)
    value_row(ui, (std::to_string(view.terms.size() - most_bars) + " more").c_str(),
              weight_text(rest_of(view)));
}

// Draws the three eigenvalues of each partial sum. The last sum is the matrix that the methods exponentiate.
void partial_sums(const Context& ui, const VertexView& view) {
  constexpr float height = 84, right = 64;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float wide = ImGui::GetContentRegionAvail().x - right;
  double low = 0, high = 0;
  for (const auto& term : view.terms) {
    low = std::min(low, term.eigenvalues[0]);
    high = std::max(high, term.eigenvalues[2]);
  }
  if (!(high - low > 1e-9)) {
    low -= 0.01;
    high += 0.01;
  }
  const auto y_of = [&](double value) {
    return at.y + 4 + static_cast<float>((high - value) / (high - low)) * (height - 8);
  };
  const auto x_of = [&](std::size_t terms) {
    // Square root scale, since the first terms contribute most.
    return at.x + std::sqrt(static_cast<float>(terms) / static_cast<float>(view.terms.size())) * wide;
  };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, {at.x + wide, at.y + height}, ui.colors.card, 4);
  draw.AddLine({at.x, y_of(0)}, {at.x + wide, y_of(0)}, ui.colors.line);
  float last_text = -100;
  for (std::size_t k = 3; k-- > 0;) {
    std::vector<ImVec2> line{{at.x, y_of(0)}};
    for (std::size_t i = 0; i < view.terms.size(); ++i)
      line.push_back({x_of(i + 1), y_of(view.terms[i].eigenvalues[k])});
    const ImU32 color = ui.colors.axis[2 - k];
    draw.AddPolyline(line.data(), static_cast<int>(line.size()), color, 0, 1.75f);
    draw.AddCircleFilled(line.back(), 3, color);
    const std::string text = formatted("%+.4f", view.terms.back().eigenvalues[k]);
    ImGui::PushFont(ui.fonts.numbers);
    last_text = std::max(line.back().y - 7, last_text + 15);
    draw.AddText({at.x + wide + 8, last_text}, color, text.c_str());
    ImGui::PopFont();
  }
  ImGui::Dummy({wide, height});
}

void evaluations(const Context& ui, const VertexView& view) {
  for (const auto& evaluation : view.evaluations) {
    value_row(ui, (method_label(evaluation.method) + ": " + evaluation.route).c_str(),
              error(evaluation.error));
    hint(
        "Algorithm that the method uses for this matrix. The case depends on the number of equal "
        "eigenvalues. Errors are relative to 106-bit results.");
  }
}

}  // namespace

void panel_vertex(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  if (!w.document.has_cage() || !section(ui, "Vertex inspector", false)) return;
  if (std::exchange(w.view.vertex.appearing, false)) ImGui::SetScrollHereY(0);
  const VertexView& view = w.view.vertex;
  if (!view.vertex)
    return note(ui,
                "Point at the model and press " +
                    workspace::text(w.preferences.keymap.of(*workspace::find_command("pick_vertex")).first) +
                    " to inspect a vertex.");
  value_row(ui, "Vertex", std::to_string(*view.vertex));
  command_row(ui, {"pick_worst", "drop_vertex"});
  if (view.terms.empty()) return note(ui, "The cage does not influence this vertex.");
  note(ui, "Weights", ui.colors.text);
  weights(ui, view);
  if (!view.has_logs) return note(ui, "This blend uses no logarithms.");
  note(ui, "Eigenvalues of the sum after each term", ui.colors.text);
  partial_sums(ui, view);
  value_row(ui, "Rotation angle", formatted("%.2f\u00b0", view.degrees));
  note(ui, "Exponential of the sum", ui.colors.text);
  evaluations(ui, view);
}

void vertex_overlay(const Context& ui) {
  constexpr std::size_t most_elements = 16;
  const workspace::Workspace& w = ui.workspace;
  const workspace::VertexView& view = w.view.vertex;
  if (!view.vertex || !w.document.model().surface) return;
  const interact::Projector project(w.document.space(), w.view.camera, w.view.viewport);
  const auto at = project(w.frame.posed.at(*w.document.model().surface, *view.vertex));
  if (!at) return;
  OverlayPainter painter(ui);
  const double largest = view.terms.empty() ? 1 : std::abs(view.terms.front().weight);
  for (std::size_t i = 0; i < std::min(most_elements, view.terms.size()); ++i) {
    const auto& term = view.terms[i];
    const auto share = static_cast<float>(std::abs(term.weight) / largest);
    const auto end = project(term.at);
    if (!end || share < 0.02f) continue;
    painter.line(glm::vec2(*at), glm::vec2(*end), term.weight < 0 ? ui.colors.warn : ui.colors.accent,
                 0.75f + 3 * share, 0.35f + 0.5f * share);
  }
  painter.disc(glm::vec2(*at), 4, ui.colors.highlight, 1);
}

}  // namespace viete::ui
