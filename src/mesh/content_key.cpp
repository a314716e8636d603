#include "mesh/content_key.h"

#include "base/encoding.h"

namespace viete::mesh {

std::uint64_t content_key(const Surface& surface) {
  base::Checksum sum;
  sum.add(surface.positions.data(), surface.positions.size() * sizeof(Point));
  sum.add(surface.triangles.data(), surface.triangles.size() * sizeof(Triangle));
  return sum.value();
}

}  // namespace viete::mesh
