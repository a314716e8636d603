#include "base/memory.h"

#include <fstream>

#include "base/error.h"
#include "base/quantity.h"

namespace viete::base {

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
  const std::string rest = free ? ", of which " + memory_size(*free) + " are free" : "";
  throw Error(need.place, need.taker + " " + memory_size(need.bytes) + " of memory" + rest, need.advice);
}

void require_memory(const MemoryNeed& need) {
  const auto free = free_memory();
  if (free && need.bytes > 0.9 * *free) refuse_memory(need);
}

}  // namespace viete::base
