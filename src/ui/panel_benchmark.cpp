#include <algorithm>

#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float name_width = 92, value_width = 116, row_height = 10;

// name, bar, time, and how many times faster than the first: one line.
void bar(const Context& ui, const scene::BenchmarkBar& bar, double longest, double first) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
  const float room = width - name_width - value_width;
  const float length = std::max(2.0f, room * static_cast<float>(bar.ns / longest));
  const float x = at.x + name_width, y = at.y + 0.5f * (line - row_height);
  ImGui::GetWindowDrawList()->AddRectFilled({x, y}, {x + length, y + row_height},
                                            bar.ours ? ui.colors.accent : ui.colors.faint, 2);
  text_right(ui, at.x + width - 48, nanoseconds(bar.ns), bar.ours ? ui.colors.text : ui.colors.faint);
  text_right(ui, at.x + width, ratio(first / bar.ns), ui.colors.faint);
  ImGui::TextUnformatted(bar.name.c_str());
}

}  // namespace

void panel_benchmark(const Context& ui) {
  if (!section(ui, "Benchmark", false)) return;
  const scene::Benchmark& bench = ui.workspace.benchmark;
  for (const auto& entry : bench.bars) {
    double longest = 0;
    for (const auto& other : bench.bars) longest = std::max(longest, other.ns);
    bar(ui, entry, longest, bench.bars.front().ns);
  }
  if (bench.count > 0) {
    note(ui, "A matrix; times faster than Diag. " + count(bench.count) +
                 " matrices S = M M^T, double, one thread.");
  } else if (!bench.running) {
    note(ui,
         "Every method on the paper's random matrices, against a copy of the same bytes. Takes some seconds, "
         "aside.");
  }
  if (bench.running) progress_bar(ui, ImGui::GetContentRegionAvail().x, bench.done);
  if (bench.running) {
    command_row(ui, {"stop_benchmark"});
  } else {
    command_row(ui, {"run_benchmark", "show_report"});
  }
}

}  // namespace viete::ui
