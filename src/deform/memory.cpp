#include "deform/memory.h"

#include <cstdio>
#include <string>

#include "base/error.h"
#include "base/memory.h"

namespace viete::deform {

namespace {

std::string gigabytes(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GB", bytes / 1e9);
  return text;
}

}  // namespace

void refuse_memory(double bytes, std::size_t vertices, std::size_t handles) {
  const auto available = base::free_memory();
  const std::string rest = available ? ", of which " + gigabytes(*available) + " are free" : "";
  throw base::Error("",
                    "binding " + std::to_string(vertices) + " vertices to " + std::to_string(handles) +
                        " cage elements takes " + gigabytes(bytes) + " of memory" + rest,
                    "use a coarser cage or a coarser model");
}

void require_memory(double bytes, std::size_t vertices, std::size_t handles) {
  const auto available = base::free_memory();
  if (available && bytes > 0.9 * *available) refuse_memory(bytes, vertices, handles);
}

}  // namespace viete::deform
