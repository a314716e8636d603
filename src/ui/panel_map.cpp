#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "document/brush.h"
#include "ui/choice_list.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/split.h"

namespace viete::ui {

void panel_display(const Context& ui) {
  if (!section(ui, "Display", false)) return;
  const float half = 0.5f * ImGui::GetContentRegionAvail().x;
  const float left = ImGui::GetCursorPosX();
  constexpr const char* pairs[][2] = {{"toggle_model", "toggle_wireframe"},
                                      {"toggle_cage", "toggle_ghost"},
                                      {"toggle_grid", "toggle_theme"},
                                      {"toggle_orthographic", "toggle_axes"},
                                      {"toggle_deformed", "toggle_z_up"}};
  for (const auto& [one, other] : pairs) {
    command_toggle(ui, one);
    ImGui::SameLine(left + half);
    command_toggle(ui, other);
  }
  command_toggle(ui, "toggle_coarse_motion");
  const auto shading = static_cast<std::size_t>(ui.workspace.view.options.shading);
  command_choice(ui, {"shading_clay", "shading_porcelain", "shading_jade"}, shading);
  command_choice(ui, {"shading_file", "shading_checker"}, shading - 3);
  command_choice(ui, {"shading_normals", "shading_zebra"}, shading - 5);
}

void panel_map(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  if (!w.document.model().surface) return;
  const analysis::Field wanted = w.view.options.field;
  const bool open = section(ui, "Map", false);
  section_note(ui, wanted == analysis::Field::none ? "" : std::string(base::entry_of(wanted).label));
  if (!open) return;
  choice_list(ui, "map", std::optional(wanted), ImGui::GetContentRegionAvail().x);
  if (wanted == analysis::Field::none)
    return note(ui, "Choose a measure of the deformation to colour the model.");
  if (analysis::entry(wanted).needs_faces && !w.document.has_faces())
    return note(ui, "Not available here: this map needs a model with faces.");
  if (workspace::shown_field(w) == analysis::Field::none)
    return note(ui, "Not available here: this map needs a cage and the blend \"Log space\".");
  const bool needs_selection = wanted == analysis::Field::influence && w.document.selection().empty();
  note_within(
      ui, 2,
      needs_selection ? "Select a probe or a part of the cage." : std::string(base::entry_of(wanted).hint));
  command_toggle(ui, "hold_map_range");
  command_button(ui, "frame_worst", ImGui::GetContentRegionAvail().x);
}

namespace {

constexpr float legend_margin = 12, thickness = 10, bars = 34;

// Size of the legend. `whole` is for one view and has a histogram. `small` is for several views and has none.
// `tiny` has only the colour bar with two numbers.
struct Size {
  float width, height, bars;
  bool words = true;
};
constexpr Size whole{264, 134, bars}, small{216, 84, 0}, tiny{126, 40, 0, false};

struct Legend {
  const Context& ui;
  ImDrawList& draw;
  const analysis::FieldStats& stats;
  ImVec2 at;  // the upper left corner of the colour bar
  Size size;

  float length() const { return size.width - 2 * legend_margin; }
  float x_of(double value) const {
    const double share = std::clamp((value - stats.low) / (stats.high - stats.low), 0.0, 1.0);
    return at.x + static_cast<float>(share) * length();
  }
};

void colors(const Legend& l, const std::vector<ImU32>& all) {
  const float step = l.length() / static_cast<float>(all.size() - 1);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const float x = l.at.x + static_cast<float>(i) * step;
    l.draw.AddRectFilledMultiColor({x, l.at.y}, {x + step, l.at.y + thickness}, all[i], all[i + 1],
                                   all[i + 1], all[i]);
  }
}

// Draws the histogram. The height of a bar is the square root of the count, so that small counts are visible.
void counts(const Legend& l) {
  const auto& all = l.stats.counts;
  const auto most = static_cast<float>(std::max(1u, *std::ranges::max_element(all)));
  const float step = l.length() / static_cast<float>(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const float tall = bars * std::sqrt(static_cast<float>(all[i]) / most);
    const float x = l.at.x + static_cast<float>(i) * step;
    l.draw.AddRectFilled({x, l.at.y - 3 - tall}, {x + step - 1, l.at.y - 3}, faded(l.ui.colors.faint, 0.7f));
  }
}

void tick(const Legend& l, double value, const std::string& text) {
  const float x = l.x_of(value), wide = ImGui::CalcTextSize(text.c_str()).x;
  l.draw.AddLine({x, l.at.y + thickness}, {x, l.at.y + thickness + 4}, l.ui.colors.faint);
  const float left = std::clamp(x - wide / 2, l.at.x, l.at.x + l.length() - wide);
  l.draw.AddText({left, l.at.y + thickness + 5}, l.ui.colors.text, text.c_str());
}

void ticks(const Legend& l) {
  ImGui::PushFont(l.ui.fonts.numbers);
  const bool in_powers = analysis::entry(l.stats.field).scale == analysis::Scale::log10;
  const int low = static_cast<int>(l.stats.low), high = static_cast<int>(l.stats.high);
  if (!l.size.words) {
    for (const double value : {l.stats.low, l.stats.high})
      tick(l, value,
           in_powers ? "1e" + std::to_string(std::lround(value)) : analysis::text(l.stats.field, value));
  } else if (in_powers) {
    for (int at = low + 1; at < high; at += (high - low + 4) / 5) tick(l, at, "1e" + std::to_string(at));
  } else {
    for (const double share : {0.0, 0.5, 1.0}) {
      const double value = l.stats.low + share * (l.stats.high - l.stats.low);
      tick(l, value, analysis::text(l.stats.field, value));
    }
  }
  ImGui::PopFont();
}

// The value of `shown` at the point of the model under the cursor. The cursor may be in any view.
std::optional<double> pointed_value(const workspace::Workspace& w, const workspace::FieldView& shown) {
  const auto& cursor = w.view.interaction.cursor;
  if (!cursor || !shown.values || w.view.interaction.drag || ImGui::GetIO().WantCaptureMouse)
    return std::nullopt;
  const auto hit =
      document::pick_corners(w.document, w.frame.posed, w.view.camera.ray(*cursor, w.view.viewport));
  if (!hit) return std::nullopt;
  double value = 0;
  for (std::size_t k = 0; k < 3; ++k)
    value += hit->shares[k] * static_cast<double>((*shown.values)[hit->corners[k]]);
  return value;
}

void pointer(const Legend& l, double value) {
  const float x = l.x_of(value), y = l.at.y - 1;
  l.draw.AddTriangleFilled({x - 5, y - 7}, {x + 5, y - 7}, {x, y}, l.ui.colors.text);
  if (!l.size.words) return;
  const std::string text = analysis::text(l.stats.field, value);
  ImGui::PushFont(l.ui.fonts.numbers);
  const float wide = ImGui::CalcTextSize(text.c_str()).x;
  l.draw.AddText({l.at.x + l.length() - wide, l.at.y - l.size.bars - (l.size.bars > 0 ? 48 : 27)},
                 l.ui.colors.accent, text.c_str());
  ImGui::PopFont();
}

std::string title(const workspace::FieldView& shown, analysis::Field field, workspace::Method method) {
  std::string text(base::entry_of(field).label);
  if (field == analysis::Field::exp_error)
    text += " by " + method_label(shown.stats.vertices ? shown.stats.method : method);
  const std::string_view unit = analysis::entry(field).unit;
  return unit.empty() ? text : text + ", " + std::string(unit);
}

std::string extent(const workspace::FieldView& shown, float room) {
  const analysis::FieldStats& stats = shown.stats;
  if (!shown.problem.empty()) return shortened(shown.problem, room);
  if (!shown.values) return "computing";
  if (stats.is_nan) return "some values are NaN";
  const std::string ends =
      analysis::text(stats.field, stats.least) + " to " + analysis::text(stats.field, stats.most);
  const std::string median = "median " + analysis::text(stats.field, stats.median);
  const bool fits = ImGui::CalcTextSize((ends + ", " + median).c_str()).x <= room;
  return ends + (fits ? ", " : "\n") + median;
}

// Draws the legend with its lower right corner near `corner`. Returns its height.
float legend(const Context& ui, ImVec2 corner, const workspace::FieldView& shown, analysis::Field field,
             workspace::Method method, const Size& size) {
  const float room = size.width - 2 * legend_margin;
  ImGui::PushFont(ui.fonts.text);
  const std::string numbers = size.words ? extent(shown, room) : "";
  const float more = numbers.find('\n') == std::string::npos ? 0 : ImGui::GetTextLineHeight();
  const float height = size.height + more;
  const ImVec2 low{corner.x - size.width - 16, corner.y - height - 16};
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled(low, {low.x + size.width, low.y + height}, faded(ui.colors.card, 0.92f), 8);
  if (size.words)
    draw.AddText({low.x + legend_margin, low.y + 8}, ui.colors.text,
                 shortened(title(shown, field, method), room).c_str());
  draw.AddText({low.x + legend_margin, low.y + 27}, ui.colors.faint, numbers.c_str());
  ImGui::PopFont();
  const float above = (size.words ? 52 + more : 10) + size.bars + (size.bars > 0 ? 4 : 0);
  const Legend made{ui, draw, shown.stats, {low.x + legend_margin, low.y + above}, size};
  colors(made, analysis::entry(field).symmetric ? ui.field_colors.diverging : ui.field_colors.even);
  if (!shown.values) return height;
  if (size.bars > 0) counts(made);
  ticks(made);
  if (const auto value = pointed_value(ui.workspace, shown)) pointer(made, *value);
  return height;
}

}  // namespace

namespace {

// True if a legend fits beside the tools and covers only the lowest part of a view.
bool fits(const Size& size, const glm::vec2& room) {
  constexpr float gap = 24;
  return room.x >= size.width + gap && room.y >= 3 * size.height;
}

}  // namespace

// Draws the legend of the mesh colours at the bottom right of each view. Notices are placed above the legend.
float map_legend(const Context& ui, float bottom) {
  const auto& w = ui.workspace;
  if (ui.field_colors.even.empty()) return bottom;
  float top = bottom;
  auto& split = w.view.split;
  for (std::size_t view = 0; view < split.count(); ++view) {
    const analysis::Field field = workspace::shown_field(w, view);
    if (field == analysis::Field::none) continue;
    const workspace::Pane pane = workspace::pane_of(split, view);
    const glm::vec2 corner = w.view.viewport.origin + (pane.at + pane.size) * w.view.viewport.size;
    constexpr float tools = 60;
    const float beside = pane.at.x == 0 && w.view.options.panels ? tools : 0;
    const glm::vec2 room = pane.size * w.view.viewport.size - glm::vec2(beside, 0);
    if (!fits(tiny, room)) continue;
    const Size& size = !split.on() && fits(whole, room) ? whole : fits(small, room) ? small : tiny;
    const float height = legend(ui, vec(corner), split.views[view].shown, field,
                                workspace::view_settings(w, view).method, size);
    if (ui.recorder)
      ui.recorder->add("legend/" + std::to_string(view), {corner.x - size.width - 16, corner.y - height - 16,
                                                          corner.x - 16, corner.y - 16, true, true});
    if (corner.y > bottom - 1) top = bottom - height - 32;
  }
  return top;
}

}  // namespace viete::ui
