// The sliders of a cage that is being made.
#include <algorithm>
#include <cmath>

#include "scene/document/cage_making.h"
#include "ui/choice_list.h"
#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float making_label = 84, making_value = 52;

// A slider with its value at the right of it.
Slid slider_row(const Context& ui, const char* text, const std::string& name, float& value, float least,
                float most, ImGuiSliderFlags flags, const std::string& shown, const char* sentence) {
  row_label(text, making_label);
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  ImGui::SetNextItemWidth(-making_value);
  flags |= ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput;
  const Slid slid = slider(ui, name, value, least, most, [&] {
    return ImGui::SliderFloat(("##" + name).c_str(), &value, least, most, "", flags);
  });
  hint(sentence);
  value_beside(right, shown);
  return slid;
}

// Steps that a hand can find again: 12, 14 ... 100, 110 ... 2,000.
std::size_t rounded_triangles(float value) {
  const double step = value < 40 ? 2 : value < 100 ? 5 : value < 400 ? 10 : 50;
  return static_cast<std::size_t>(std::lround(value / step) * std::lround(step));
}

void triangles(const Context& ui, scene::CageWish& wish) {
  constexpr float most = 2000;  // more take long, and are no cage that a person poses
  auto value = static_cast<float>(wish.triangles);
  const Slid slid =
      slider_row(ui, "Triangles", "cage_triangles", value, scene::least_triangles, most,
                 ImGuiSliderFlags_Logarithmic, count(wish.triangles),
                 "How many the cage has: fewer are posed more quickly, more follow the model more closely.");
  if (slid.moved) wish.triangles = rounded_triangles(value);
  if (slid.typed) wish.triangles = static_cast<std::size_t>(std::lround(*slid.typed));
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, share < 0.00995 ? "%.2f %%" : "%.1f %%", 100 * share);
  return text;
}

void share(const Context& ui, const char* text, const char* name, double& share, double least, double most,
           const char* sentence) {
  auto value = static_cast<float>(100 * share);
  const Slid slid =
      slider_row(ui, text, name, value, static_cast<float>(100 * least), static_cast<float>(100 * most),
                 ImGuiSliderFlags_Logarithmic, percent(share), sentence);
  if (slid.typed) share = std::clamp(0.01 * *slid.typed, least, most);
  if (slid.moved) {
    const double step = value < 1 ? 0.05 : 0.5;  // percent
    share = std::clamp(0.01 * step * std::round(static_cast<double>(value) / step), least, most);
  }
}

void cells(const Context& ui, scene::CageWish& wish) {
  constexpr const char* names[] = {"cage_cells_x", "cage_cells_y", "cage_cells_z"};
  constexpr const char* labels[] = {"Cells, x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    auto value = static_cast<float>(wish.cells[k]);
    const Slid slid = slider_row(ui, labels[k], names[k], value, 1, 12, 0, count(wish.cells[k]),
                                 "Into how many cells the box is cut along this axis.");
    if (slid.moved || slid.typed)
      wish.cells[k] = static_cast<std::size_t>(std::lround(slid.typed.value_or(value)));
  }
  ImGui::Checkbox("Along the model's own axes", &wish.own_axes);
  record(ui, "cage_own_axes");
}

template <class Entry, class Value>
void choice(const Context& ui, const char* text, const std::string& name, std::span<const Entry> table,
            Value& value) {
  row_label(text, making_label);
  ImGui::SetNextItemWidth(-1);
  value = entry_list(ui, name, table, value).value_or(value);
}

}  // namespace

void panel_making(const Context& ui) {
  scene::CageMaking& making = ui.workspace.making;
  scene::CageWish& wish = making.wish;
  choice(ui, "Kind", "cage_kind", scene::all_kinds(), wish.kind);
  if (wish.kind == scene::CageKind::box) {
    cells(ui, wish);
  } else {
    triangles(ui, wish);
  }
  share(ui, "Margin", "cage_margin", wish.margin, scene::least_margin, 0.1,
        "The distance that the cage keeps from the model, in percent of its diagonal.");
  if (wish.kind == scene::CageKind::automatic) {
    share(ui, "Close gaps", "cage_gap", wish.gap, 0.001, 0.1,
          "Gaps of the model narrower than twice this, in percent of its diagonal, are closed: fingers grow "
          "together.");
    choice(ui, "Symmetry", "cage_symmetry", scene::all_symmetries(), wish.symmetry);
    ImGui::Checkbox("Mostly quads", &wish.quads);
    record(ui, "cage_quads");
    hint("Triangles are paired where two make a good quad.");
  }
  if (scene::shows_made(ui.workspace.document, making)) {  // not after an undo
    for (const auto& lines : {making.notes, making.lost})
      for (const std::string& line : lines) note(ui, line, ui.colors.warn);
    if (!making.lost.empty()) record(ui, "making_lost");
  }
  command_row(ui, {"finish_cage", "cancel_cage"});
}

}  // namespace viete::ui
