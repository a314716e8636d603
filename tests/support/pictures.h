// Reads and compares pictures.
#pragma once

#include <filesystem>

#include "render/image.h"

namespace viete::test {

/// Reads a picture. If the file is not a picture, the test case fails.
render::Image read_png(const std::filesystem::path& path);

/// Returns the fraction of pixels in which a channel differs by more than `tolerance` levels. If the sizes
/// differ, the test case fails.
double difference(const render::Image& a, const render::Image& b, int tolerance);

/// Returns the mean colours of cells of `cell` x `cell` pixels, without incomplete cells.
render::Image shrunk(const render::Image& image, int cell);

}  // namespace viete::test
