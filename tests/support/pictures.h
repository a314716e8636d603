// Reads and compares pictures.
#pragma once

#include <filesystem>

#include "render/image.h"

namespace viete::test {

/// Fails the test case if the file is not a picture.
render::Image read_png(const std::filesystem::path& path);

/// The fraction of pixels in which a channel differs by more than `tolerance` levels. Fails the test case if
/// the sizes differ.
double difference(const render::Image& a, const render::Image& b, int tolerance);

}  // namespace viete::test
