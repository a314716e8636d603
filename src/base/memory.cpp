#include "base/memory.h"

#include <cstdio>
#include <fstream>

#include "base/error.h"

namespace viete::base {

namespace {

std::string gigabytes(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GB", bytes / 1e9);
  return text;
}

}  // namespace

std::optional<double> free_memory() {
  std::ifstream in("/proc/meminfo");
  std::string key, unit;
  double kilobytes = 0;
  while (in >> key >> kilobytes) {
    if (key == "MemAvailable:") return kilobytes * 1024;
    std::getline(in, unit);
  }
  return std::nullopt;
}

void refuse_memory(const MemoryNeed& need) {
  const auto free = free_memory();
  const std::string rest = free ? ", of which " + gigabytes(*free) + " are free" : "";
  throw Error(need.place, need.taker + " " + gigabytes(need.bytes) + " of memory" + rest, need.advice);
}

void require_memory(const MemoryNeed& need) {
  const auto free = free_memory();
  if (free && need.bytes > 0.9 * *free) refuse_memory(need);
}

}  // namespace viete::base
