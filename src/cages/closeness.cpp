#include "cages/closeness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cages/frame.h"
#include "mesh/summary.h"
#include "mesh/triangle_tree.h"

namespace viete::cages {

Closeness closeness(const mesh::Surface& cage, const mesh::Surface& model, base::WorkerPool& pool) {
  const Frame frame = frame_of(model, std::nullopt);
  const FramedModel framed = model_in(frame, model);
  std::vector<std::uint8_t> used(framed.positions.size(), 0);
  for (const auto& t : framed.triangles) used[t[0]] = used[t[1]] = used[t[2]] = 1;
  std::vector<mesh::Point> corners = cage.positions;
  for (mesh::Point& p : corners) p = frame.into(p);
  const mesh::TriangleTree tree(corners, cage.triangles);
  std::vector<double> distances(framed.positions.size());
  pool.for_blocks(distances.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (used[v]) distances[v] = std::sqrt(tree.nearest(framed.positions[v]).squared_distance);
    }
  });
  Closeness found{.least = std::numeric_limits<double>::infinity()};
  std::size_t count = 0;
  for (std::size_t v = 0; v < distances.size(); ++v) {
    if (!used[v]) continue;
    ++count;
    found.mean += distances[v];
    found.least = std::min(found.least, distances[v]);
    found.most = std::max(found.most, distances[v]);
  }
  found.mean /= static_cast<double>(count);
  // What is wound oddly, or lies within itself, has no such volume; then it can seem larger than the cage's.
  const mesh::Summary summary = mesh::summarize(model);
  const double whole = mesh::summarize(cage).volume, part = std::abs(summary.volume);
  if (summary.closed() && summary.oriented() && part > 0 && part <= whole) found.volume = whole / part;
  return found;
}

}  // namespace viete::cages
