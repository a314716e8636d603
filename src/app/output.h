// The files that a command writes: what they may replace.
#pragma once

#include <filesystem>
#include <vector>

namespace viete::app {

/// What is written.
enum class Content { surface, binding, picture, json, svg, animation };

/// Before the work starts: throws base::Error where the file cannot be written, where it is one of `inputs`
/// (by file, whatever its name or the link to it), or where it holds something else than what replaces it.
/// The last two not with `force`. An empty name, and inputs that are empty or not there, pass. A surface
/// replaces any file of its extension, which chose the format; so do JSON and animations (MDD, video); the
/// others are known by how they begin.
void check_output(const std::filesystem::path& file, Content content,
                  const std::vector<std::filesystem::path>& inputs, bool force);

/// Where the numbers of a benchmark go; empty: nowhere.
struct BenchFiles {
  std::filesystem::path json, plot;
  bool force = false;

  /// As check_output(); neither may be the other, nor one of `inputs`.
  void check(std::vector<std::filesystem::path> inputs = {}) const;
};

}  // namespace viete::app
