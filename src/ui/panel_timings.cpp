#include <algorithm>
#include <array>

#include "ui/format.h"
#include "ui/frame_parts.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

using Part = std::optional<std::size_t>;

constexpr std::size_t legend_rows = 6;  // as many as a stitched frame has: none comes or goes under the hand

bool is_under_cursor(ImVec2 low, ImVec2 high) {
  return ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high);
}

Part bar(const Context& ui, const Parts& parts) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 14;
  double total = 0;
  for (const double ms : parts) total += ms;
  Part under_cursor;
  float x = at.x;
  for (std::size_t i = 0; i < part_count; ++i) {
    const float w = static_cast<float>(parts[i] / std::max(total, 1e-9)) * width;
    const ImVec2 low{x, at.y}, high{x + w, at.y + height};
    ImGui::GetWindowDrawList()->AddRectFilled(low, high, lit_part_color(ui, i));
    if (w > 0 && is_under_cursor(low, high)) under_cursor = i;
    x += w;
  }
  ImGui::Dummy({width, height});
  return under_cursor;
}

// stale: of a frame before the newest ones.
Part legend_entry(const Context& ui, std::size_t part, double ms, bool stale, ImVec2 at, float width) {
  const float line = ImGui::GetTextLineHeight(), middle = at.y + 0.5f * line;
  const bool lit = ui.workspace.interaction.part == part;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({at.x, middle - 4}, {at.x + 8, middle + 4}, lit_part_color(ui, part), 2);
  draw.AddText({at.x + 16, at.y}, lit ? ui.colors.text : ui.colors.faint, part_name(part).c_str());
  text_right(ui, at.x + width, milliseconds(ms), stale ? ui.colors.faint : ui.colors.text, at.y);
  const ImVec2 high{at.x + width, at.y + line};
  return is_under_cursor(at, high) ? Part(part) : std::nullopt;
}

// Fused and stitched frames have other links than staged and plain ones.
bool is_of_path(const Parts& frame, const Parts& other) {
  const auto alike = [&](scene::Link link) {
    const auto i = static_cast<std::size_t>(link);
    return (frame[i] > 0) == (other[i] > 0);
  };
  return alike(scene::Link::fused) && alike(scene::Link::solve);
}

// A link that a frame of this path does without for a while, as skeletons during a drag, keeps its row.
std::array<bool, part_count> parts_with_rows(const Context& ui, const Parts& deforming) {
  std::array<bool, part_count> rows{};
  for (const auto& frame : ui.workspace.stats.history()) {
    const Parts parts = parts_of(frame);
    if (!is_of_path(parts, deforming)) continue;
    for (std::size_t i = 0; i < part_count; ++i) rows[i] = rows[i] || parts[i] > 0;
  }
  for (std::size_t i = 0; i < part_count; ++i)
    rows[i] = rows[i] || i >= scene::link_count || deforming[i] > 0;
  return rows;
}

// Two columns, read downwards; links that this path does not have are left out.
Part legend(const Context& ui, const Parts& newest, const Parts& deforming) {
  std::array<std::size_t, part_count> shown{};
  std::size_t count = 0;
  const auto has_row = parts_with_rows(ui, deforming);
  for (std::size_t i = 0; i < part_count; ++i) {
    if (has_row[i]) shown[count++] = i;
  }
  const std::size_t rows = std::max(legend_rows, (count + 1) / 2);
  const bool deformed = newest[static_cast<std::size_t>(scene::Link::maps)] > 0;
  constexpr float gap = 16;
  const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  Part under_cursor;
  const auto entry = [&](std::size_t i, ImVec2 at) {
    const std::size_t part = shown[i];
    const bool link = part < scene::link_count;
    if (const Part hit =
            legend_entry(ui, part, link ? deforming[part] : newest[part], link && !deformed, at, width))
      under_cursor = hit;
  };
  for (std::size_t row = 0; row < rows; ++row) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (row < count) entry(row, at);
    if (row + rows < count) entry(row + rows, {at.x + width + gap, at.y});
    ImGui::Dummy({0, ImGui::GetTextLineHeight()});
  }
  return under_cursor;
}

// One column of pixels per frame, stacked like the bar, newest at the right.
void history(const Context& ui) {
  const auto& frames = ui.workspace.stats.history();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 56;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, {at.x + width, at.y + height}, ui.colors.card, 4);
  double top = 1;
  for (const auto& frame : frames) top = std::max(top, frame.frame);
  constexpr float step = 2;
  float x = at.x + width -
            step * static_cast<float>(std::min<std::size_t>(frames.size(), std::size_t(width / step)));
  for (std::size_t f = frames.size() - std::size_t((at.x + width - x) / step); f < frames.size();
       ++f, x += step) {
    float y = at.y + height;
    const Parts parts = parts_of(frames[f]);
    for (std::size_t i = 0; i < part_count; ++i) {
      const float h = static_cast<float>(parts[i] / top) * (height - 4);
      draw.AddRectFilled({x, y - h}, {x + step, y}, lit_part_color(ui, i));
      y -= h;
    }
  }
  ImGui::Dummy({width, height});
  const std::string which = frames.size() == 1 ? "The last frame that deformed"
                                               : "The last " + count(frames.size()) + " frames that deformed";
  hint(which + "; full height is " + milliseconds(top) + ".");
}

void tell_part(const std::string& text) {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(280);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

// The part under the cursor, wherever it is shown.
Part show_frame(const Context& ui) {
  Part under_cursor = frame_formula(ui);
  const auto newest = ui.workspace.stats.median(), deforming = ui.workspace.stats.deforming_median();
  if (!newest || !deforming) {
    note(ui, ui.workspace.document.is_movable()
                 ? "Drag a vertex of the cage, or a probe, to see what each link of the frame costs."
                 : "What each link of the frame costs is shown once a cage or a probe moves the model.");
    return under_cursor;
  }
  const Parts parts = parts_of(*newest);
  value_row(ui, "Frame", milliseconds(newest->frame));
  if (const Part hit = bar(ui, parts)) under_cursor = hit;
  if (const Part hit = legend(ui, parts, parts_of(*deforming))) under_cursor = hit;
  history(ui);
  return under_cursor;
}

}  // namespace

void panel_timings(const Context& ui) {
  Part& part = ui.workspace.interaction.part;
  if (!section(ui, "Timings")) return part.reset();
  part = show_frame(ui);
  if (part) tell_part(part_name(*part) + ": " + part_hint(*part));
}

}  // namespace viete::ui
