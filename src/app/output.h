// The files that a command writes: what they may replace.
#pragma once

#include <filesystem>

#include "scene/files/output.h"

namespace viete::app {

using scene::check_output, scene::Content, scene::FilesInUse;

/// What a command writes.
struct Output {
  std::filesystem::path file;
  Content content;
  bool force = false;
};

/// Where the numbers of a benchmark go; empty: nowhere.
struct BenchFiles {
  std::filesystem::path json, plot;
  bool force = false;

  /// As check_output(); neither may be the other, nor one of `inputs`.
  void check(const FilesInUse& inputs = {}) const {
    check_output(json, Content::json, inputs, force);
    FilesInUse all = inputs;
    all.add(json, "the numbers");
    check_output(plot, Content::svg, all, force);
  }
};

}  // namespace viete::app
