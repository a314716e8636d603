#include "cages/capture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/text.h"
#include "mesh/drawing.h"

namespace viete::cages {

namespace {

constexpr double cell_size = 5;  // relative to the usual distance to the nearest splat
constexpr std::size_t least_neighbours = 3;

using CountedCell = std::array<std::int64_t, 3>;

// Numbers of points in the cells of a grid.
class CellCounts {
public:
  CellCounts(std::span<const mesh::Point> points, double size) : size_(size) {
    for (const mesh::Point& p : points) ++counts_[key(cell_of(p))];
  }
  // Returns the number of points in the point's cell and the 26 cells around it.
  std::size_t around(const mesh::Point& p) const {
    const CountedCell middle = cell_of(p);
    std::size_t sum = 0;
    for (std::int64_t i = 0; i < 27; ++i) {
      const auto found =
          counts_.find(key({middle[0] + i / 9 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i % 3 - 1}));
      if (found != counts_.end()) sum += found->second;
    }
    return sum;
  }

private:
  CountedCell cell_of(const mesh::Point& p) const {
    constexpr double farthest = 1 << 20;  // far cells may coincide; there are few points
    CountedCell cell;
    for (std::size_t k = 0; k < 3; ++k)
      cell[k] = static_cast<std::int64_t>(std::floor(std::clamp(p[k] / size_, -farthest, farthest)));
    return cell;
  }
  static std::uint64_t key(const CountedCell& cell) {
    std::uint64_t key = 0;
    for (const std::int64_t c : cell) key = key << 21 | (static_cast<std::uint64_t>(c) & 0x1fffff);
    return key;
  }

  double size_;
  std::unordered_map<std::uint64_t, std::uint32_t> counts_;
};

}  // namespace

CaptureCore core_of(std::shared_ptr<const mesh::Surface> capture, const mesh::Splats& splats) {
  const std::vector<mesh::Point>& points = capture->positions;
  std::vector<mesh::Point> opaque;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!splats.is_faint(i)) opaque.push_back(points[i]);
  const double spacing = mesh::point_spacing(opaque);
  if (!(spacing > 0)) return {std::move(capture), ""};
  const CellCounts cells(opaque, cell_size * spacing);
  mesh::Surface core;
  for (const mesh::Point& p : opaque)
    if (cells.around(p) > least_neighbours) core.positions.push_back(p);
  const std::size_t faint = points.size() - opaque.size(), alone = opaque.size() - core.positions.size();
  if (faint + alone == 0 || !(mesh::bounds(core.positions).diagonal() > 0)) return {std::move(capture), ""};
  std::vector<std::string> kinds;
  if (faint > 0) kinds.push_back(base::counted(faint, "splat") + " with opacity below 0.05");
  if (alone > 0) kinds.push_back(base::counted(alone, "lonely splat"));
  return {std::make_shared<const mesh::Surface>(std::move(core)),
          base::joined(kinds, " and ") + " may be outside of the cage"};
}

}  // namespace viete::cages
