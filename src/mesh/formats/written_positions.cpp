#include "mesh/formats/written_positions.h"

#include <array>
#include <cstdio>

#include "base/error.h"

namespace viete::mesh {

namespace {

[[noreturn]] void refuse(const std::string& place, std::size_t vertex, const Point& p, double largest) {
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(), "the position of vertex %zu is no place (%.3g %.3g %.3g)", vertex,
                p[0], p[1], p[2]);
  if (!is_place(p))
    throw base::Error(place, text.data(), "use other weights or another blend, or a pose nearer to rest");
  std::snprintf(text.data(), text.size(), "the position of vertex %zu is beyond %.3g (%.3g %.3g %.3g)",
                vertex, largest, p[0], p[1], p[2]);
  throw base::Error(place, text.data(), "scale the model, or write .obj or .ply, which hold larger numbers");
}

}  // namespace

void check_written(const std::string& place, std::size_t vertex, const Point& p, double largest) {
  if (!is_place(p, largest)) refuse(place, vertex, p, largest);
}

void check_written(const std::string& place, std::span<const Point> positions, double largest) {
  if (positions.empty())
    throw base::Error(place, "there are no vertices to write", "name a mesh that has some");
  for (std::size_t v = 0; v < positions.size(); ++v) check_written(place, v, positions[v], largest);
}

}  // namespace viete::mesh
