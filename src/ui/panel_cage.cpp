#include <algorithm>
#include <cmath>

#include "document/cage_making.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/workspace.h"

namespace viete::ui {

namespace {

std::string surface_text(const document::OpenedSurface& opened) {
  const document::Summary& summary = opened.summary;
  if (opened.splats) return "capture";
  if (summary.polygons == 0) return "points";
  const std::string kind = !summary.manifold() ? "not manifold" : summary.closed() ? "watertight" : "open";
  return summary.parts > 1 ? kind + ", " + count(summary.parts) + " parts" : kind;
}

}  // namespace

void panel_model(const Context& ui) {
  const auto& model = ui.workspace.document.model();
  const bool open = section(ui, "Model");
  if (model.surface) section_note(ui, surface_text(model));
  if (!open) return;
  if (!model.surface && ui.workspace.jobs.loading.running) return note(ui, ui.workspace.jobs.loading.what);
  if (!model.surface) {
    note(ui, "No model. Open a model or drop a file on the window.");
    command_button(ui, "open_model");
    if (const auto clicked = recent_list(ui)) open_recent(ui.workspace, *clicked);
    return;
  }
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(model.path.filename().string().c_str());
  ImGui::PopTextWrapPos();
  hint(model.path.string() + "  (" + model.format + ")");
  if (ui.workspace.document.has_faces())
    value_row(ui, "Vertices, triangles",
              count(model.summary.vertices) + "  " + count(model.summary.triangles));
  else
    value_row(ui, model.splats ? "Splats" : "Points", count(model.summary.vertices));
  command_row(ui, {"open_model", "save_model"});
}

void panel_cage(const Context& ui) {
  const auto& document = ui.workspace.document;
  const bool open = section(ui, "Cage");
  if (document.has_cage()) section_note(ui, document.cage_file().summary.closed() ? "watertight" : "open");
  if (!open) return;
  const bool wishing = ui.workspace.making.open && !ui.workspace.making.closing;
  if (wishing) panel_making(ui);
  if (!document.has_cage()) {
    if (wishing) return;
    note(ui, "No cage. A cage is a coarse mesh around the model.");
    command_row(ui, {"open_cage", "make_cage"});
    return;
  }
  ImGui::TextUnformatted(name_of(document.cage_file()).c_str());
  hint(place_of(document.cage_file()) + "  (" + document.cage_file().format + ")");
  const auto& summary = document.cage_file().summary;
  value_row(ui, "Vertices, triangles", count(summary.vertices) + "  " + count(summary.triangles));
  command_row(ui, {"open_cage", "make_cage", "edit_cage"});
  if (!document.kept_pose()) return;
  command_row(ui, {"split_edges", "cut_faces", "extrude_faces"});
  command_row(ui, {"merge_vertices", "remove_elements", "subdivide_cage"});
  command_row(ui, {"mirror_cage", "fit_cage", "enclose_model"});
}

namespace {

constexpr float making_label = 84;

// Rounds to steps that grow with the value: 12, 14, ... 40, 45, ... 100, 110, ... 400, 450, ...
double rounded_triangles(double value) {
  const double step = value < 40 ? 2 : value < 100 ? 5 : value < 400 ? 10 : 50;
  return static_cast<double>(std::lround(value / step) * std::lround(step));
}

void triangles(const Context& ui, document::CageWish& wish) {
  const auto chosen = slider_row(
      ui, "Triangles", making_label, "cage_triangles", static_cast<double>(wish.triangles),
      count(wish.triangles),
      {.least = document::least_triangles,
       .most = 2000,  // larger cages are slow to bind and hard to pose
       .tip =
           "Number of triangles of the cage. Fewer triangles are easier to pose; more triangles follow the "
           "model more closely.",
       .logarithmic = true,
       .rounded = rounded_triangles});
  if (chosen) wish.triangles = static_cast<std::size_t>(std::lround(*chosen));
}

std::string percent(double share) {
  return formatted(share < 0.00995 ? "%.2f %%" : "%.1f %%", 100 * share);
}

void share(const Context& ui, const char* text, const char* name, double& share, double least, double most,
           const char* tip) {
  const auto rounded = [](double percent) {
    const double step = percent < 1 ? 0.05 : 0.5;
    return step * std::round(percent / step);
  };
  const auto chosen = slider_row(
      ui, text, making_label, name, 100 * share, percent(share),
      {.least = 100 * least, .most = 100 * most, .tip = tip, .logarithmic = true, .rounded = rounded});
  if (chosen) share = std::clamp(0.01 * *chosen, least, most);
}

void cells(const Context& ui, document::CageWish& wish) {
  constexpr const char* names[] = {"cage_cells_x", "cage_cells_y", "cage_cells_z"};
  constexpr const char* labels[] = {"Cells X", "Y", "Z"};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto chosen =
        slider_row(ui, labels[k], making_label, names[k], static_cast<double>(wish.cells[k]),
                   count(wish.cells[k]), {.least = 1, .most = 12, .tip = "Number of cells along this axis."});
    if (chosen) wish.cells[k] = static_cast<std::size_t>(std::lround(*chosen));
  }
  ImGui::Checkbox("Align to principal axes", &wish.own_axes);
  record(ui, "cage_own_axes");
}

template <class Value>
void choice(const Context& ui, const char* text, const std::string& name, Value& value) {
  row_label(text, making_label);
  ImGui::SetNextItemWidth(-1);
  value = entry_list(ui, name, std::optional(value)).value_or(value);
}

}  // namespace

void panel_making(const Context& ui) {
  document::CageMaking& making = ui.workspace.making;
  document::CageWish& wish = making.wish;
  choice(ui, "Kind", "cage_kind", wish.kind);
  if (wish.kind == document::CageKind::box) {
    cells(ui, wish);
  } else {
    triangles(ui, wish);
  }
  share(ui, "Margin", "cage_margin", wish.margin, document::least_margin, 0.1,
        "Minimum distance between cage and model, in percent of the model's diagonal.");
  if (wish.kind == document::CageKind::automatic) {
    share(
        ui, "Close gaps", "cage_gap", wish.gap, 0.001, 0.1,
        "Close gaps narrower than twice this distance, in percent of the model's diagonal. Joins parts that "
        "are close to each other, such as fingers.");
    choice(ui, "Symmetry", "cage_symmetry", wish.symmetry);
    checkbox(ui, "Mostly quads", "cage_quads", wish.quads, "Pair triangles that form good quads.");
  }
  if (document::shows_generated(ui.workspace.document, making)) {  // false after an undo
    for (const auto& lines : {making.notes, making.lost})
      for (const std::string& line : lines) note(ui, line, ui.colors.warn);
    if (!making.lost.empty()) record(ui, "making_lost");
  }
  command_row(ui, {"finish_cage", "cancel_cage"});
}

namespace {

constexpr float offer_padding = 16;

// Shows a title and a sentence, in lines that fit beside the tools. Returns the width of the text.
float words(const Context& ui, const std::string& title, const std::string& what) {
  ImGui::PushFont(ui.fonts.strong);
  const float wide = ImGui::CalcTextSize(title.c_str()).x;
  const float width = std::min(std::max(320.0f, wide), notice_room(ui) - 2 * offer_padding);
  text_in(ui.colors.text, wrapped(title, width));
  ImGui::PopFont();
  text_in(ui.colors.faint, wrapped(what, width));
  ImGui::Dummy({width, 2});
  return width;
}

void cage_sources(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  const float width =
      words(ui, "This model has no cage", "A cage is a coarse mesh around the model. Drag it to deform.");
  if (!w.document.cage_beside().empty()) {
    text_in(ui.colors.text, w.document.cage_beside().filename().string() + " is in the same folder.");
    command_button(ui, "open_cage_beside", width);
  }
  command_button(ui, "make_cage", width);
  command_row(ui, {"open_cage", "hide_cage_offer"});
}

}  // namespace

float cage_offer(const Context& ui, float bottom) {
  const workspace::Workspace& w = ui.workspace;
  if (!workspace::offers_next_step(w)) return bottom;
  const Window window("Cage offer",
                      {.at = middle_at(ui, bottom - 28), .pivot = {0.5f, 1}, .padding = {offer_padding, 14}},
                      card_flags);
  if (const document::Finding* finding = workspace::offered_finding(w)) {
    const float width = words(ui, document::title(*finding), document::meaning(*finding));
    const auto commands = {"show_outside", "enclose_model", "hide_cage_offer"};
    const bool in_row = width > 240;
    for (const char* command : commands) {
      if (in_row && command != *commands.begin()) ImGui::SameLine();
      command_button(ui, command, in_row ? (width - 2 * ImGui::GetStyle().ItemSpacing.x) / 3 : width);
    }
  } else {
    cage_sources(ui);
  }
  return ImGui::GetWindowPos().y + 28;
}

}  // namespace viete::ui
