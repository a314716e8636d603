#include "scene/quantity.h"

#include <algorithm>
#include <cstdio>

namespace viete::scene {

std::string with_thousands(std::size_t n) {
  std::string digits = std::to_string(n);
  for (int i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3)
    digits.insert(static_cast<std::size_t>(i), ",");
  return digits;
}

std::string memory_size(std::size_t bytes) {
  char text[32];
  const double megabytes = std::max(1.0, static_cast<double>(bytes) * 1e-6);
  if (megabytes < 999.5) {
    std::snprintf(text, sizeof text, "%.0f MB", megabytes);
  } else {
    std::snprintf(text, sizeof text, "%.1f GB", megabytes * 1e-3);
  }
  return text;
}

}  // namespace viete::scene
