// Pictures read back and compared.
#pragma once

#include <filesystem>

#include "render/image.h"

namespace viete::test {

/// Fails the case if the file is not a picture.
render::Image read_png(const std::filesystem::path& path);

/// The share of pixels (0 to 1) with a channel (r, g, b or a) that differs by more than `tolerance` levels.
/// Fails the case if the sizes differ.
double difference(const render::Image& a, const render::Image& b, int tolerance);

}  // namespace viete::test
