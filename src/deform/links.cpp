#include "deform/links.h"

#include <numeric>

namespace viete::deform {

std::string_view name(Link link) {
  static constexpr std::array<std::string_view, link_count> names = {
      "maps",  "log maps",  "blend", "exp",    "apply",  "skeleton",
      "fused", "triangles", "solve", "probes", "normals"};
  return names[static_cast<std::size_t>(link)];
}

double LinkTimes::total() const {
  return std::accumulate(ms.begin(), ms.end(), 0.0);
}

LinkTimes& LinkTimes::operator+=(const LinkTimes& other) {
  for (std::size_t i = 0; i < link_count; ++i) ms[i] += other.ms[i];
  return *this;
}

}  // namespace viete::deform
