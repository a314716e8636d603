// What a picture can tell of the model instead of how it looks, for compositing and papers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/viewer.h"

namespace viete::app {

/// Distances along the view in the model's units, top row first; 0 where the model is not.
struct DepthPicture {
  int width = 0, height = 0;
  std::vector<float> depths;
};
DepthPicture depth_of(Viewer& viewer);

/// A PNG: depth as grey, near white; or, of depth, a PFM file with the distances themselves. Returns what a
/// person should know to read it. Throws base::Error.
std::string write_pass(Viewer& viewer, render::Pass pass, const std::filesystem::path& file);

}  // namespace viete::app
