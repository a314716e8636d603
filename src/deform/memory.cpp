#include "deform/memory.h"

#include <cstdio>
#include <fstream>
#include <optional>
#include <string>

#include "base/error.h"

namespace viete::deform {

namespace {

// Nothing where the system does not say.
std::optional<double> free_bytes() {
  std::ifstream in("/proc/meminfo");
  std::string key, unit;
  double kilobytes = 0;
  while (in >> key >> kilobytes) {
    if (key == "MemAvailable:") return kilobytes * 1024;
    std::getline(in, unit);
  }
  return std::nullopt;
}

std::string gigabytes(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GB", bytes / 1e9);
  return text;
}

}  // namespace

void refuse_memory(double bytes, std::size_t vertices, std::size_t handles) {
  const auto available = free_bytes();
  const std::string rest = available ? ", of which " + gigabytes(*available) + " are free" : "";
  throw base::Error("",
                    "binding " + std::to_string(vertices) + " vertices to " + std::to_string(handles) +
                        " cage elements takes " + gigabytes(bytes) + " of memory" + rest,
                    "use a coarser cage or a coarser model");
}

void require_memory(double bytes, std::size_t vertices, std::size_t handles) {
  const auto available = free_bytes();
  if (available && bytes > 0.9 * *available) refuse_memory(bytes, vertices, handles);
}

}  // namespace viete::deform
