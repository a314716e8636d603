#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "document/edit.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command.h"

namespace viete::ui {

namespace {

constexpr const char* command_names[] = {"method_diag", "method_sd", "method_improved_sd", "method_fast"};

// True if this method is better than all other methods. False at rest, because all methods are exact.
bool is_best(const workspace::MethodStats& stats, std::size_t index, double workspace::MethodSample::*value) {
  const workspace::MethodSample& own = stats.samples[index];
  return !std::isnan(own.*value) && std::ranges::all_of(stats.samples, [&](const auto& other) {
    return &other == &own || !(other.*value <= own.*value);
  });
}

// Errors above this limit are highlighted, because they can add up to visible errors.
bool is_visible(const workspace::MethodSample& sample) {
  return !(sample.worst_error < 1e-10);
}

// A line of a card: what the value is, and the value.
void card_line(const Context& ui, ImVec2 at, float width, std::string what, const std::string& value,
               ImU32 color) {
  constexpr float margin = 10, gap = 6, smaller = 0.87f;
  ImGui::PushFont(ui.fonts.numbers);
  const float room = width - 2 * margin - gap - ImGui::CalcTextSize(value.c_str()).x;
  ImGui::PopFont();
  // In a narrow column only the last word fits.
  if (smaller * ImGui::CalcTextSize(what.c_str()).x > room) what.erase(0, what.rfind(' ') + 1);
  ImGui::GetWindowDrawList()->AddText(nullptr, smaller * ImGui::GetFontSize(), {at.x + margin, at.y},
                                      ui.colors.faint, what.c_str());
  text_right(ui, at.x + width - margin, value, color, at.y);
}

void card_text(const Context& ui, ImVec2 at, float width, const char* title,
               const workspace::MethodSample* sample, bool used, bool fastest, bool most_exact, bool active) {
  constexpr float margin = 10;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 text = used ? ui.colors.text : ui.colors.faint;
  ImGui::PushFont(ui.fonts.strong);
  draw.AddText({at.x + margin, at.y + 6}, text, title);
  ImGui::PopFont();
  if (active && used) draw.AddCircleFilled({at.x + width - 13, at.y + 14}, 4, ui.colors.accent);
  if (!sample) return;
  card_line(ui, {at.x, at.y + 24}, width, "per matrix", nanoseconds(sample->ns_per_matrix),
            fastest ? ui.colors.accent : text);
  card_line(ui, {at.x, at.y + 40}, width, "largest error", rough_error(sample->worst_error),
            is_visible(*sample) ? ui.colors.warn
            : most_exact        ? ui.colors.accent
                                : ui.colors.faint);
}

// A large button with the method's name, time per matrix and largest error. The best values are coloured.
void method_card(const Context& ui, std::size_t index, float width, bool used) {
  workspace::Workspace& w = ui.workspace;
  const workspace::Command& command = *workspace::find_command(command_names[index]);
  const bool active = w.document.method() == analysis::compared_methods[index];
  const ImVec2 at = ImGui::GetCursorScreenPos(), size{width, 62};
  if (ImGui::InvisibleButton(command_names[index], size)) command.run(w);
  record(ui, command_names[index], used);
  card(ui, at, {at.x + size.x, at.y + size.y}, active && used);
  const bool measured = running_sample(w) != nullptr;
  card_text(ui, at, width, command.brief.data(), measured ? &w.frame.methods.samples[index] : nullptr, used,
            is_best(w.frame.methods, index, &workspace::MethodSample::ns_per_matrix),
            is_best(w.frame.methods, index, &workspace::MethodSample::worst_error), active);
  hint(std::string(command.hint) + "  (" + workspace::text(w.preferences.keymap.of(command).first) + ")");
}

}  // namespace

void panel_method(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  const bool used = w.document.deformer().exponential();
  heading(ui, "Method");
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  ImGui::BeginDisabled(!used);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
  for (std::size_t i = 0; i < analysis::compared_methods.size(); ++i) {
    method_card(ui, i, width, used);
    if (i % 2 == 0) ImGui::SameLine();
  }
  ImGui::PopStyleVar();
  ImGui::EndDisabled();
  const bool orange = running_sample(w) && std::ranges::any_of(w.frame.methods.samples, is_visible);
  note(ui, !used                                      ? "This deformer uses no exponential."
           : !document::differs_from_rest(w.document) ? "Pose the cage to compare the methods."
           : orange                                   ? "Orange errors can become visible."
                                                      : "Medians over the matrices of this frame.");
  hint("Median time over " + count(w.frame.methods.matrices) +
       " matrices of this frame; errors are relative to 106-bit results. Teal marks the best values, "
       "orange errors above 1e-10, which can add up to visible errors. At rest all errors are 0.");
}

namespace {

using analysis::compared_methods;
using workspace::Stage;
using StageUnderCursor = std::optional<Stage>;

constexpr std::size_t all_methods = compared_methods.size();

const char* stage_hint(workspace::Stage stage) {
  static constexpr std::array<const char*, workspace::stage_count> hints = {
      "Affine map x -> M x + l of each element of the cage, from rest to pose.",
      "Polar decomposition M = R S of each map, and the logarithms Y = log R and X = log S.",
      "Weighted sums of the logarithms at each vertex.",
      "Exponentials of symmetric 3x3 matrices, one per vertex, by the chosen method.",
      "Stretch, rotation and translation of each vertex.",
      "Weighted sums at pivot vertices of each block, from compressed weights.",
      "Sums, exponential and application in one pass over the vertices, in single precision.",
      "Rotation and stretch of each triangle of the model, fitted to the blended vertices.",
      "Sparse linear solve for the positions whose triangles follow these maps best.",
      "Probes, applied after the cage.",
      "Vertex normals, from the triangles around each vertex.",
      "Derivatives of the deformation, which stretch and turn Gaussian splats."};
  return hints[static_cast<std::size_t>(stage)];
}

// The colour of the stage, fainter if another stage is hovered.
ImU32 lit_stage_color(const Context& ui, workspace::Stage stage) {
  const auto& lit = ui.workspace.view.interaction.stage;
  return faded(stage_color(stage), lit && *lit != stage ? 0.3f : 1.0f);
}

bool is_under_cursor(ImVec2 low, ImVec2 high) {
  return ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high);
}

// Draws one segment per stage; the slowest method fills the width. Returns the stage under the cursor.
StageUnderCursor segments(const Context& ui, const workspace::StageTimes& times, double longest, ImVec2 at,
                          float width) {
  constexpr float height = 14;
  StageUnderCursor under_cursor;
  float x = at.x;
  for (std::size_t i = 0; i < workspace::stage_count; ++i) {
    const float w = static_cast<float>(times.ms[i] / longest) * width;
    const ImVec2 low{x, at.y + 2}, high{x + w, at.y + 2 + height};
    ImGui::GetWindowDrawList()->AddRectFilled(low, high, lit_stage_color(ui, static_cast<Stage>(i)));
    if (w > 0 && is_under_cursor(low, high)) under_cursor = static_cast<Stage>(i);
    x += w;
  }
  return under_cursor;
}

std::string label_of(const Context& ui, std::size_t index) {
  if (!ui.workspace.document.deformer().exponential()) return "All";  // the methods do not differ
  return method_label(index < all_methods ? compared_methods[index] : workspace::Method::fast);
}

// The bar of an entry of MethodTimes::stages. Returns the stage under the cursor.
StageUnderCursor bar(const Context& ui, std::size_t index, double longest) {
  constexpr float label_width = 88, value_width = 68;
  const workspace::MethodTimes& all = ui.workspace.frame.method_times;
  const workspace::StageTimes& times = all.stages[index];
  const bool runs = index == workspace::running_times(ui.workspace);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, room = width - label_width - value_width;
  text_in(runs ? ui.colors.accent : ui.colors.faint, label_of(ui, index));
  record(ui, "timings/" + (index < all_methods ? label_of(ui, index) : "fused"));
  if (times.total() > 0) {
    text_right(ui, at.x + width, milliseconds(times.total()), all.busy ? ui.colors.faint : ui.colors.text,
               at.y);
    return segments(ui, times, longest, {at.x + label_width, at.y}, room);
  }
  if (all.measured) {
    hint("This method needs much memory for this model. Select a method other than Fast to measure it.");
    ImGui::GetWindowDrawList()->AddText({at.x + label_width, at.y}, ui.colors.faint, "not measured");
  }
  return std::nullopt;
}

// A text above bars that names their engine.
void engine_line(const Context& ui, const char* engine, const char* tip) {
  text_in(ui.colors.faint, wrapped(engine, ImGui::GetContentRegionAvail().x));
  hint(tip);
}

// The bars of all methods in one engine, and below the bar of `fast` in the fused engine, with its error.
StageUnderCursor engine_bars(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  double longest = 1e-9;
  for (const auto& times : w.frame.method_times.stages) longest = std::max(longest, times.total());
  StageUnderCursor stage;
  const auto add = [&](std::size_t index) {
    if (const StageUnderCursor hit = bar(ui, index, longest)) stage = hit;
  };
  if (w.document.deformer().exponential()) {
    engine_line(
        ui, w.document.deformer().stitched() ? "Stitched engine" : "Same engine: staged, double precision",
        "These times compare the methods: all other steps are the same.");
    for (std::size_t i = 0; i < all_methods; ++i) add(i);
  }
  if (w.document.deformer().stitched()) return stage;
  ImGui::Dummy({1, 2});
  engine_line(
      ui, "Fused engine: one pass, single precision",
      "The engine of the method Fast, and of deformers without exponentials. It differs from the staged "
      "engine in steps, precision and memory, so that its time does not compare methods.");
  add(workspace::MethodTimes::fused);
  return stage;
}

bool is_measured(const workspace::MethodTimes& all, Stage stage) {
  return std::ranges::any_of(all.stages, [&](const auto& times) { return times[stage] > 0; });
}

// Draws the names of the stages, up to four per line. Returns the stage under the cursor.
StageUnderCursor legend(const Context& ui) {
  constexpr std::size_t rows = 2;
  constexpr float longest_name = 70;
  const workspace::Workspace& w = ui.workspace;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float room = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight() + 2;
  const auto columns = static_cast<std::size_t>(std::clamp(room / longest_name, 1.0f, 4.0f));
  const float width = room / static_cast<float>(columns);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  StageUnderCursor under_cursor;
  std::size_t count = 0;
  for (std::size_t i = 0; i < workspace::stage_count; ++i) {
    const Stage stage = static_cast<Stage>(i);
    if (!is_measured(w.frame.method_times, stage)) continue;
    const ImVec2 low{at.x + static_cast<float>(count % columns) * width,
                     at.y + static_cast<float>(count / columns) * line};
    const float middle = low.y + 0.5f * line;
    draw.AddRectFilled({low.x, middle - 4}, {low.x + 8, middle + 4}, lit_stage_color(ui, stage), 2);
    const bool lit = w.view.interaction.stage == stage;
    draw.AddText({low.x + 13, low.y}, lit ? ui.colors.text : ui.colors.faint,
                 std::string(name(stage)).c_str());
    if (is_under_cursor(low, {low.x + width, low.y + line})) under_cursor = stage;
    ++count;
  }
  const std::size_t lines = std::max(rows, (count + columns - 1) / columns);
  ImGui::Dummy({1, static_cast<float>(lines) * line});
  return under_cursor;
}

void stage_tooltip(const Context& ui, Stage stage) {
  std::string text = std::string(name(stage)) + ": " + stage_hint(stage);
  for (std::size_t i = 0; i <= all_methods; ++i) {
    const double ms = ui.workspace.frame.method_times.stages[i][stage];
    const char* engine = i == workspace::MethodTimes::fused ? ", fused engine: " : ": ";
    if (ms > 0) text += "\n" + label_of(ui, i) + engine + milliseconds(ms);
  }
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(wrapped(text, 268).c_str());
  ImGui::EndTooltip();
}

// Shows the times of a frame's parts after the deformation, and the total, with headings above the numbers.
void rest_of_frame(const Context& ui) {
  struct Column {
    const char* heading;
    float right;  // right edge as a fraction of the width
    std::string value{};
  };
  std::array<Column, 5> columns{
      {{"upload", 0.17f}, {"panels", 0.36f}, {"draw", 0.53f}, {"total", 0.75f}, {"frames/s", 1}}};
  ImU32 color = ui.colors.text;
  if (const auto& frame = ui.workspace.view.split.views[0].stats.median()) {
    columns[0].value = base::few_digits(frame->upload);
    columns[1].value = base::few_digits(frame->panels);
    columns[2].value = base::few_digits(frame->draw);
    columns[3].value = milliseconds(frame->frame);
    columns[4].value = base::few_digits(1000 / std::max(frame->frame, 1e-3));
    if (frame->busy) color = ui.colors.faint;
  }
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
  for (const Column& column : columns) {
    const float right = at.x + column.right * width;
    ImGui::GetWindowDrawList()->AddText({right - ImGui::CalcTextSize(column.heading).x, at.y},
                                        ui.colors.faint, column.heading);
    text_right(ui, right, column.value, color, at.y + line);
  }
  ImGui::Dummy({width, 2 * line});
  hint(
      "Times of the other parts of a frame in milliseconds: medians of the last half second. The total "
      "includes the deformation.");
}

// The error of the fused engine, from the shown frame if it ran, or measured beside the times.
void frame_error(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  const double shown = w.view.split.views[0].fused_error;
  const double error = shown > 0 ? shown : w.frame.method_times.fused_error;
  const std::string number = rough_error(error),
                    long_text = "largest error " + number + " of the cage's diagonal";
  const bool fits = ImGui::CalcTextSize(long_text.c_str()).x < ImGui::GetContentRegionAvail().x;
  text_in(ui.colors.faint, error > 0 ? fits ? long_text : "largest error " + number : " ");
  record(ui, "errors");
  hint("Largest distance of a sample of vertices from their positions in double precision.");
}

}  // namespace

void panel_timings(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  const bool busy = w.frame.method_times.busy;
  heading(ui, busy ? "Timings" : "Timings of the deformation");
  if (busy) section_note(ui, std::string(busy_words));
  StageUnderCursor stage = engine_bars(ui);
  frame_error(ui);
  if (const StageUnderCursor hit = legend(ui)) stage = hit;
  w.view.interaction.stage = stage;
  if (stage) stage_tooltip(ui, *stage);
  rest_of_frame(ui);
}

}  // namespace viete::ui
