#include "document/mirror.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/normals.h"
#include "mesh/point_tree.h"

namespace viete::document {

namespace {

constexpr double near_share = 0.02;  // relative to the diagonal; manual cages are not exactly symmetric

Mirror paired(const pose::Cage& cage, const mesh::PointTree& tree, const cages::Plane& plane) {
  const auto& points = cage.surface.positions;
  std::vector<std::uint32_t> image(points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) image[v] = tree.nearest(reflected(plane, points[v]));
  Mirror mirror{plane, std::vector(points.size(), Mirror::none)};
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    const double off = mesh::norm(points[image[v]] - reflected(plane, points[v]));
    if (image[image[v]] == v && off <= near_share * cage.diagonal) mirror.partners[v] = image[v];
  }
  return mirror;
}

std::vector<cages::Plane> candidates(const pose::Cage& cage, MirrorPlane choice) {
  if (choice == MirrorPlane::none) return {};
  if (choice == MirrorPlane::fit) {
    const auto plane = cages::symmetry_plane(cage.surface, nullptr);
    return plane ? std::vector{*plane} : std::vector<cages::Plane>{};
  }
  const auto axis = static_cast<std::size_t>(choice) - static_cast<std::size_t>(MirrorPlane::x);
  mesh::Vec3 normal{0, 0, 0};
  normal[axis] = 1;
  return {{normal, 0}, {normal, mesh::bounds(cage.surface.positions).center()[axis]}};
}

}  // namespace

mesh::Point reflected(const cages::Plane& plane, const mesh::Point& p) {
  return p - (2 * (mesh::dot(plane.normal, p) - plane.offset)) * plane.normal;
}

mesh::Vec3 reflected_direction(const cages::Plane& plane, const mesh::Vec3& d) {
  return d - (2 * mesh::dot(plane.normal, d)) * plane.normal;
}

std::size_t Mirror::unpaired() const {
  return static_cast<std::size_t>(std::ranges::count(partners, none));
}

std::optional<Mirror> mirror_of(const pose::Cage& cage, MirrorPlane choice) {
  const std::vector<cages::Plane> planes = candidates(cage, choice);
  if (planes.empty()) return std::nullopt;
  const mesh::PointTree tree(cage.surface.positions, mesh::first_numbers(cage.surface.positions.size()));
  Mirror best = paired(cage, tree, planes.front());
  for (std::size_t i = 1; i < planes.size() && best.unpaired() > 0; ++i) {
    Mirror other = paired(cage, tree, planes[i]);
    if (other.unpaired() < best.unpaired()) best = std::move(other);
  }
  return best;
}

std::array<mesh::Point, 4> rectangle_in_plane(const Mirror& mirror, std::span<const mesh::Point> positions) {
  constexpr double margin = 0.08, endless = std::numeric_limits<double>::max();
  const mesh::Vec3& normal = mirror.plane.normal;
  const mesh::Vec3 across = std::abs(normal[1]) < 0.9 ? mesh::Vec3{0, 1, 0} : mesh::Vec3{0, 0, 1};
  const mesh::Vec3 to_side = mesh::cross(across, normal);
  const std::array<mesh::Vec3, 2> axes{(1 / mesh::norm(to_side)) * to_side,
                                       mesh::cross(normal, (1 / mesh::norm(to_side)) * to_side)};
  std::array<double, 2> low{endless, endless}, high{-endless, -endless};
  for (const mesh::Point& p : positions)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], mesh::dot(axes[k], p));
      high[k] = std::max(high[k], mesh::dot(axes[k], p));
    }
  for (std::size_t k = 0; k < 2; ++k) {
    const double more = margin * (high[k] - low[k]);
    low[k] -= more;
    high[k] += more;
  }
  const auto corner = [&](double u, double v) {
    return mesh::Point(mirror.plane.offset * normal + u * axes[0] + v * axes[1]);
  };
  return {corner(low[0], low[1]), corner(high[0], low[1]), corner(high[0], high[1]), corner(low[0], high[1])};
}

void MirrorCache::follow(const std::shared_ptr<const pose::Cage>& now, MirrorPlane chosen) {
  if (now == cage && chosen == choice) return;
  cage = now;
  choice = chosen;
  mirror = now ? mirror_of(*now, chosen) : std::nullopt;
}

std::vector<std::uint32_t> with_partners(std::vector<std::uint32_t> vertices, const Mirror* mirror) {
  if (!mirror) return vertices;
  const std::size_t count = vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (mirror->is_paired(vertices[i])) vertices.push_back(mirror->partners[vertices[i]]);
  }
  std::ranges::sort(vertices);
  vertices.erase(std::ranges::unique(vertices).begin(), vertices.end());
  return vertices;
}

}  // namespace viete::document
