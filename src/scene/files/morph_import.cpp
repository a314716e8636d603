#include "scene/files/morph_import.h"

#include <numeric>

#include "base/error.h"
#include "base/text.h"
#include "mesh/formats/read.h"
#include "mesh/point_tree.h"

namespace viete::scene {

// The range of positions that GPUs and deformers support, as for any opened surface.
void check_places(const std::string& place, std::span<const mesh::Point> positions) {
  constexpr double largest = 1e32;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (mesh::largest_abs(positions[v]) <= largest) continue;
    throw base::Error(place, "vertex " + std::to_string(v) + " is too far away to be drawn",
                      "export it again in another unit");
  }
}

void check_points(const std::string& place, std::size_t found, const PosedSurface& of) {
  const std::size_t wanted = of.surface.positions.size();
  if (found == wanted) return;
  throw base::Error(place,
                    "it moves " + base::counted(found, "point") + ", and " + of.what + " has " +
                        base::with_thousands(wanted) + " vertices",
                    std::string("choose a file made from ") + of.what);
}

std::vector<mesh::Point> MorphPositions::of_surface(const std::vector<mesh::Point>& of_file) const {
  std::vector<mesh::Point> positions;
  for (const auto v : order) positions.push_back(of_file[v]);
  return positions;
}

namespace {

// Each vertex has one partner.
std::vector<std::uint32_t> order_by_place(const std::string& file, const mesh::Surface& found,
                                          const PosedSurface& of) {
  std::vector<std::uint32_t> all(found.positions.size());
  std::iota(all.begin(), all.end(), 0U);
  if (mesh::same_faces(found, of.surface)) return all;
  const mesh::PointTree tree(found.positions, all);
  std::vector<bool> taken(all.size());
  const double near = 1e-6 * mesh::used_bounds(of.surface).diagonal();
  std::vector<std::uint32_t> order;
  for (const mesh::Point& p : of.surface.positions) {
    const std::uint32_t v = tree.nearest(p);
    if (taken[v] || mesh::norm(found.positions[v] - p) > near)
      throw base::Error(
          file,
          std::string("its rest shape is not ") + of.what + ": it has no vertex at the position of vertex " +
              std::to_string(order.size()),
          std::string("export ") + of.what + " itself, as it is at rest, in the same axes and unit");
    taken[v] = true;
    order.push_back(v);
  }
  return order;
}

}  // namespace

MorphPositions morphs_of(const std::filesystem::path& file, const PosedSurface& of,
                         std::vector<std::string>& warnings) {
  constexpr bool played = true;
  const mesh::ReadResult read = mesh::read(file, nullptr, played);
  warnings.insert(warnings.end(), read.warnings.begin(), read.warnings.end());
  MorphPositions found{read.original ? read.original->morphs() : nullptr, {}};
  if (!found.clip) return found;
  check_points(file.string(), read.surface.positions.size(), of);
  found.order = order_by_place(file.string(), read.surface, of);
  warnings.insert(warnings.end(), found.clip->notes().begin(), found.clip->notes().end());
  return found;
}

}  // namespace viete::scene
