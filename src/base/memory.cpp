#include "base/memory.h"

#include <fstream>
#include <string>

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

}  // namespace viete::base
