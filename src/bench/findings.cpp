#include "bench/findings.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "bench/methods.h"

namespace viete::bench {

double percent_less(double time, double than) {
  return 100 * (1 - time / than);
}

std::string percent(double value) {
  return std::to_string(std::lround(value)) + "\u00a0%";
}

const FrameTime* frame_of(std::span<const FrameTime> times, const std::string& name, std::size_t faces) {
  const auto found = std::ranges::find_if(
      times, [&](const FrameTime& t) { return t.name == name && t.faces == faces && t.threads == 1; });
  return found == times.end() ? nullptr : &*found;
}

const FrameTime* staged_frame(std::span<const FrameTime> times, sym3::Method method) {
  return times.empty() ? nullptr
                       : frame_of(times, "staged, " + std::string(sym3::name(method)), times.front().faces);
}

double worst_of_clusters(const std::vector<AccuracyTable>& tables, const std::string& method) {
  const auto methods = exp_methods();
  const auto at = std::ranges::find(methods, method, [](const ExpMethod& m) { return std::string(m.name); });
  double worst = 0;
  for (const AccuracyTable& table : tables) {
    if (table.by != "gap") continue;
    for (const auto& row : table.rows)
      worst = std::max(worst, row.cells[static_cast<std::size_t>(at - methods.begin())].worst);
  }
  return worst;
}

std::string lost_volume(const nlohmann::json& way) {
  const double lost = 100 * (1 - double(way["volume"]));
  return lost < 0.5 ? "nothing" : percent(lost);
}

std::string shell_word(const std::filesystem::path& path) {
  const std::string text = path.string();
  const bool plain = text.find_first_of(" '\"$&;()<>|*?[]#~`\\!") == std::string::npos;
  if (plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace viete::bench
