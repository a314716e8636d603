// The panels Display, Map (with its legend), Views, and Vertex inspector.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "document/brush.h"
#include "interact/cursor_projection.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/playing.h"
#include "workspace/workspace.h"

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
  const auto hit = document::pick_corners(w.document, w.frame.posed, w.view.camera.ray(*cursor));
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
    const document::Viewport v = workspace::viewport_of(split, w.view.camera.viewport, view);
    const glm::vec2 corner = v.high();
    constexpr float tools = 60;
    const float beside = v.pane.x == 0 && w.view.options.panels ? tools : 0;
    const glm::vec2 room = v.seen() - glm::vec2(beside, 0);
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

namespace {

void deformer_list(const Context& ui, const std::string& name, workspace::SplitView& side) {
  if (const auto preset = entry_list(ui, name, document::preset_of(side.deformer), "Custom"))
    side.deformer = document::chosen(*preset, ui.workspace.document.deformer());
}

void method_list(const Context& ui, const std::string& name, workspace::SplitView& side) {
  if (!begin_list(ui, name, method_label(side.method).c_str(), "")) return;
  for (const workspace::Method method : analysis::compared_methods) {
    const std::string label = method_label(method);
    if (list_entry(ui, label, name + '_' + label, side.method == method, "")) side.method = method;
  }
  ImGui::EndCombo();
}

void map_list(const Context& ui, const std::string& name, workspace::SplitView& side) {
  side.field = entry_list(ui, name, std::optional(side.field)).value_or(side.field);
}

void side_rows(const Context& ui, std::size_t number, workspace::SplitView& side) {
  constexpr float label = 74;
  const std::string name = "side/" + std::to_string(number);
  const auto row = [&](const char* words, auto list, const char* what) {
    row_label(words, label);
    ImGui::SetNextItemWidth(-1);
    list(ui, name + what, side);
  };
  ImGui::PushFont(ui.fonts.strong);
  note(ui, "View " + std::to_string(number + 1), ui.colors.text);
  ImGui::PopFont();
  if (ui.workspace.document.has_cage()) row("Deformer", deformer_list, "/deformer");
  if (side.deformer.exponential()) row("Method", method_list, "/method");
  row("Map", map_list, "/map");
  if (side.other_blending || workspace::has_blended_pose(ui.workspace)) {
    const char* const words =
        ui.workspace.document.timeline().linear ? "In log space" : "Linear interpolation";
    ImGui::Checkbox((std::string(words) + "##" + name).c_str(), &side.other_blending);
    record(ui, name + "/lines");
    hint("Interpolate differently from the first view, to compare log space and linear interpolation.");
  }
  if (!side.problem.empty()) note(ui, side.problem, ui.colors.bad);
}

}  // namespace

void panel_views(const Context& ui) {
  workspace::Split& split = ui.workspace.view.split;
  if (!ui.workspace.document.model().surface || !section(ui, "Views", false)) return;
  command_choice(ui, {"views_1", "views_2", "views_3", "views_4"}, split.count() - 1);
  if (!split.on()) return note(ui, "Split the view to compare deformers, methods and maps of one pose.");
  command_toggle(ui, "toggle_linked_cameras");
  for (std::size_t view = 1; view < split.count(); ++view) side_rows(ui, view, split.views[view]);
}

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
  const interact::Projector project(w.document.space(), w.view.camera);
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
