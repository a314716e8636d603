#include "mesh/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "mesh/triangle.h"

namespace viete::mesh {

namespace {

constexpr std::uint32_t triangles_per_leaf = 4;
// If the distance to a node is more than 2 * its radius, a dipole replaces the node (Barill 2018, 3.3).
constexpr double far_away = 2;

double squared_distance(const Point& p, const Bounds& box) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = std::max({box.low[k] - p[k], 0.0, p[k] - box.high[k]});
    sum += d * d;
  }
  return sum;
}

// Tests the centroid of the other triangle first, because this fast test is often sufficient.
bool are_near(const Corners& t, const Corners& other, double distance) {
  if (distance <= 0) return cut(t, other);
  const Point middle = (1.0 / 3) * (other[0] + other[1] + other[2]);
  const double gap = std::sqrt(closest_on_triangle(middle, t[0], t[1], t[2]).squared_distance);
  if (gap < distance) return true;
  double radius = 0;
  for (const Point& p : other) radius = std::max(radius, squared_norm(p - middle));
  if (gap > distance + std::sqrt(radius) * (1 + 1e-12)) return false;
  return mesh::squared_distance(t, other) < distance * distance;
}

}  // namespace

TriangleTree::TriangleTree(std::span<const Point> positions, std::span<const Triangle> triangles,
                           base::Progress* progress, std::span<const std::uint32_t> groups)
    : order_(first_numbers(triangles.size())), corners_(triangles.size()) {
  std::vector<Point> centers(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    corners_[t] = corners_of(positions, triangles[t]);
    const Bounds box = bounds(corners_[t]);
    centers[t] = 0.5 * (box.low + box.high);
  }
  nodes_.reserve(triangles.size());
  build(0, static_cast<std::uint32_t>(triangles.size()), centers, progress);
  const std::vector<Corners> unordered = std::move(corners_);
  corners_.resize(unordered.size());
  for (std::size_t t = 0; t < order_.size(); ++t) corners_[t] = unordered[order_[t]];
  if (!groups.empty()) {
    for (const auto t : order_) groups_.push_back(groups[triangles[t][0]]);
    group_nodes();
  }
  make_dipoles();
}

// Adds a node and its children. Divides the triangles into halves along the longest side of the centers' box.
std::uint32_t TriangleTree::build(std::uint32_t begin, std::uint32_t end, std::span<const Point> centers,
                                  base::Progress* progress) {
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({bounds(corners_[order_[begin]]), begin, end});
  Bounds middle{centers[order_[begin]], centers[order_[begin]]}, box = nodes_[self].box;
  for (std::uint32_t t = begin; t < end; ++t) {
    for (const Point& p : corners_[order_[t]]) extend(box, p);
    extend(middle, centers[order_[t]]);
  }
  nodes_[self].box = box;
  if (end - begin <= triangles_per_leaf) return self;
  if (progress) progress->report(static_cast<double>(begin) / static_cast<double>(order_.size()));
  const Vec3 size = middle.high - middle.low;
  const auto side = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::uint32_t s, std::uint32_t t) {
                     return centers[s][side] < centers[t][side] ||
                            (centers[s][side] == centers[t][side] && s < t);
                   });
  build(begin, half, centers, progress);
  const std::uint32_t second = build(half, end, centers, progress);
  nodes_[self].second = second;
  return self;
}

void TriangleTree::group_nodes() {
  for (Node& node : nodes_) {
    const auto own = std::span(groups_).subspan(node.begin, node.end - node.begin);
    if (std::ranges::count(own, own[0]) == std::ssize(own)) node.group = own[0];
  }
}

void TriangleTree::make_dipoles() {
  dipoles_.resize(nodes_.size());
  std::vector<double> weights(nodes_.size(), 0);
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // children have higher indices than their parent
    const Node& node = nodes_[i];
    Dipole& dipole = dipoles_[i];
    if (node.second != 0) {
      for (const std::size_t child : {i + 1, std::size_t{node.second}}) {
        dipole.area = dipole.area + dipoles_[child].area;
        dipole.center = dipole.center + weights[child] * dipoles_[child].center;
        weights[i] += weights[child];
      }
    } else {
      for (std::uint32_t t = node.begin; t < node.end; ++t) {
        const auto& [a, b, c] = corners_[t];
        const Vec3 area = 0.5 * cross(b - a, c - a);
        const double weight = norm(area);
        dipole.area = dipole.area + area;
        dipole.center = dipole.center + (weight / 3) * (a + b + c);
        weights[i] += weight;
      }
    }
    dipole.center = weights[i] > 0 ? (1 / weights[i]) * dipole.center : node.box.center();
    Vec3 farthest{};
    for (std::size_t k = 0; k < 3; ++k)
      farthest[k] = std::max(node.box.high[k] - dipole.center[k], dipole.center[k] - node.box.low[k]);
    dipole.radius = norm(farthest);
  }
}

TriangleTree::Nearest TriangleTree::nearest(const Point& p, double below) const {
  struct Open {
    std::uint32_t node;
    double squared_distance;
  };
  Nearest best{.squared_distance = below};
  const std::uint32_t none = best.triangle;
  Open stack[64];
  std::size_t size = 0;
  stack[size++] = {0, squared_distance(p, nodes_[0].box)};
  while (size > 0) {
    const Open open = stack[--size];
    if (open.squared_distance >= best.squared_distance) continue;
    const Node& node = nodes_[open.node];
    if (node.second != 0) {
      const Open first{open.node + 1, squared_distance(p, nodes_[open.node + 1].box)};
      const Open second{node.second, squared_distance(p, nodes_[node.second].box)};
      const bool in_order = first.squared_distance <= second.squared_distance;
      stack[size++] = in_order ? second : first;
      stack[size++] = in_order ? first : second;
      continue;
    }
    for (std::uint32_t t = node.begin; t < node.end; ++t) {
      const auto& [a, b, c] = corners_[t];
      const double d = closest_on_triangle(p, a, b, c).squared_distance;
      if (d < best.squared_distance) best = {order_[t], d};
    }
  }
  if (best.triangle == none) best.squared_distance = std::numeric_limits<double>::infinity();
  return best;
}

std::vector<TriangleTree::NearestOfGroup> TriangleTree::nearest_of_groups(const Point& p, double radius,
                                                                          double times,
                                                                          std::uint32_t but_group) const {
  std::vector<NearestOfGroup> found;
  double limit = radius * radius;
  const auto known = [&](std::uint32_t group) {
    return std::ranges::find(found, group, &NearestOfGroup::group);
  };
  const auto is_past = [&](std::uint32_t group, double squared) {
    if (group == but_group || squared > limit) return true;
    const auto nearest = known(group);
    return nearest != found.end() && squared >= nearest->squared_distance;
  };
  const auto enter = [&](std::uint32_t i) {
    return is_past(nodes_[i].group, squared_distance(p, nodes_[i].box)) ? Step::past : Step::into;
  };
  find(enter, [&](std::uint32_t t) {
    const auto& [a, b, c] = corners_[t];
    if (is_past(groups_[t], squared_distance(p, bounds(corners_[t])))) return false;
    const NearestOfGroup one{groups_[t], order_[t], closest_on_triangle(p, a, b, c).squared_distance};
    if (is_past(one.group, one.squared_distance)) return false;
    if (const auto nearest = known(one.group); nearest != found.end()) {
      *nearest = one;
    } else {
      found.push_back(one);
    }
    limit = std::min(limit, times * times * one.squared_distance);
    return false;
  });
  return found;
}

bool TriangleTree::is_near(const Corners& t, double distance) const {
  Bounds box = bounds(t);
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= distance;
    box.high[k] += distance;
  }
  const auto gap_to = [&](const Point& p) {
    return std::sqrt(closest_on_triangle(p, t[0], t[1], t[2]).squared_distance);
  };
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], across = cross(u, v);
  const double reach = distance * norm(across);
  const double rounding = 1e-14 * std::sqrt(squared_norm(u) * squared_norm(v));  // the error of `across`
  // True if the box is on one side of the plane of t, and farther from this plane than `distance`.
  const auto beside = [&](const Bounds& other) {
    const Vec3 middle = 0.5 * (other.low + other.high) - t[0], half = 0.5 * (other.high - other.low);
    double spread = reach;
    for (std::size_t k = 0; k < 3; ++k)
      spread += half[k] * std::abs(across[k]) + rounding * (half[k] + std::abs(middle[k]));
    return std::abs(dot(across, middle)) > spread * (1 + 1e-9);
  };
  const auto enter = [&](std::uint32_t i) {
    const Bounds& node = nodes_[i].box;
    if (!meet(node, box) || beside(node)) return Step::past;
    if (distance <= 0) return Step::into;
    // The triangles of the node are within a ball around the box.
    const double radius = 0.5 * node.diagonal() * (1 + 1e-12), gap = gap_to(node.center());
    if (gap > radius + distance) return Step::past;
    return gap + radius < distance ? Step::found : Step::into;
  };
  // True if the triangle is on one side of the plane of t, and farther from this plane than `distance`.
  const auto is_beside = [&](const Corners& other) {
    int sides = 0;
    for (const Point& p : other) {
      const Vec3 d = p - t[0];
      const double height = dot(across, d);
      const double sure = reach + rounding * (std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]));
      sides += height > sure ? 1 : height < -sure ? -1 : 0;
    }
    return std::abs(sides) == 3;
  };
  return find(enter, [&](std::uint32_t i) {
    const Corners& other = corners_[i];
    return meet(bounds(other), box) && !is_beside(other) && are_near(t, other, distance);
  });
}

double TriangleTree::winding_number(const Point& p) const {
  double halves = 0, dipoles = 0;
  const auto enter = [&](std::uint32_t i) {
    const Dipole& dipole = dipoles_[i];
    const Vec3 to = dipole.center - p;
    const double squared = squared_norm(to);
    if (!(squared > far_away * far_away * dipole.radius * dipole.radius)) return Step::into;
    dipoles += dot(dipole.area, to) / (squared * std::sqrt(squared));
    return Step::past;
  };
  find(enter, [&](std::uint32_t t) {
    halves += half_solid_angle(corners_[t][0] - p, corners_[t][1] - p, corners_[t][2] - p);
    return false;
  });
  return (2 * halves + dipoles) / (4 * std::numbers::pi);
}

namespace {

// Transforms the surface to a diagonal of 1. This keeps products in the range of double.
struct ToUnit {
  Point center;
  double scale;

  explicit ToUnit(const Surface& surface) {
    const Bounds box = used_bounds(surface);
    center = box.center();
    scale = box.diagonal() > 0 ? 1 / box.diagonal() : 1;
  }
  Point operator()(const Point& p) const { return scale * (p - center); }
};

double winding_number(std::span<const Point> positions, std::span<const Triangle> triangles, const Point& p) {
  double halves = 0;
  for (const auto& [a, b, c] : triangles)
    halves += half_solid_angle(positions[a] - p, positions[b] - p, positions[c] - p);
  return halves / (2 * std::numbers::pi);
}

}  // namespace

double winding_number(const Surface& surface, const Point& p) {
  const ToUnit unit(surface);
  std::vector<Point> positions;
  for (const Point& q : surface.positions) positions.push_back(unit(q));
  return winding_number(positions, surface.triangles, unit(p));
}

std::vector<std::uint32_t> points_outside(const Surface& cage, std::span<const Point> positions,
                                          base::WorkerPool* pool, base::Progress* progress) {
  std::vector<std::uint32_t> found = first_numbers(positions.size());
  if (cage.triangles.empty()) return found;
  const ToUnit unit(cage);
  std::vector<Point> corners;
  for (const Point& p : cage.positions) corners.push_back(unit(p));
  const TriangleTree tree(corners, cage.triangles);
  const auto is_outside = [&](const Point& at) {
    constexpr double doubt = 0.25;  // larger than the error of the tree's winding number
    const Point p = unit(at);
    double number = std::abs(tree.winding_number(p));
    if (std::abs(number - 0.5) < doubt) number = std::abs(winding_number(corners, cage.triangles, p));
    return number < 0.5 && tree.nearest(p).squared_distance > 1e-18;
  };
  std::vector<char> outside(positions.size(), 0);
  const auto decide = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (progress && i % 256 == 0)
        progress->report(static_cast<double>(i) / static_cast<double>(positions.size()));
      outside[i] = is_outside(positions[i]);
    }
  };
  if (pool) {
    pool->for_blocks(positions.size(), 256, decide);
  } else {
    decide(0, positions.size());
  }
  std::erase_if(found, [&](std::uint32_t i) { return !outside[i]; });
  return found;
}

}  // namespace viete::mesh
