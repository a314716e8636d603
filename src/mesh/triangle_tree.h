// A bounding-box tree over triangles: nearest triangle, proximity tests, winding numbers.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/progress.h"
#include "mesh/surface.h"
#include "mesh/triangle.h"

namespace viete::mesh {

/// Accepts any triangles; those without area act as their longest edge, or as a point. Copies the corners.
/// Thread-safe. Lengths from 1e-75 to 1e75.
class TriangleTree {
public:
  /// Needs at least one triangle; indices refer to positions. O(n log n), 0.3 microseconds a triangle.
  /// progress may be null; throws base::Cancelled. groups: empty, or a number per position; a triangle
  /// belongs to the group of its first corner.
  TriangleTree(std::span<const Point> positions, std::span<const Triangle> triangles,
               base::Progress* progress = nullptr, std::span<const std::uint32_t> groups = {});

  struct Nearest {
    /// The largest std::uint32_t if no triangle is near enough.
    std::uint32_t triangle = std::numeric_limits<std::uint32_t>::max();
    double squared_distance = std::numeric_limits<double>::infinity();
  };

  /// The triangle nearest to p among those with a squared distance less than `below`. The distance found does
  /// not depend on `below`. On a tie any of the triangles.
  Nearest nearest(const Point& p, double below = std::numeric_limits<double>::infinity()) const;

  struct NearestOfGroup {
    std::uint32_t group, triangle;
    double squared_distance;
  };
  /// The nearest triangle of each group except `but_group`, within radius of p; in any order. The tree must
  /// have groups.
  std::vector<NearestOfGroup> nearest_of_groups(const Point& p, double radius, std::uint32_t but_group) const;

  /// Calls visit(triangle) for each triangle whose box meets the given one.
  template <class Visit>
  void for_meeting(const Bounds& box, const Visit& visit) const {
    find([&](std::uint32_t i) { return meet(nodes_[i].box, box) ? Step::into : Step::past; },
         [&](std::uint32_t i) {
           if (meet(bounds(corners_[i]), box)) visit(order_[i]);
           return false;
         });
  }

  /// True if a triangle of the tree cuts t or is nearer to it than `distance`. t must have a plane. Cuts are
  /// exact.
  bool is_near(const Corners& t, double distance = 0) const;

  /// The generalised winding number around p, accurate to a few hundredths: distant triangles act as one
  /// dipole. Sources: Jacobson et al. 2013, Robust inside-outside segmentation using generalized winding
  /// numbers; Barill et al. 2018, Fast winding numbers for soups and clouds.
  double winding_number(const Point& p) const;

private:
  static constexpr auto no_group = std::numeric_limits<std::uint32_t>::max();
  // The triangles of a node are order_[begin] up to order_[end]. The first child is the next node, the other
  // is `second`, which is 0 in a leaf. As large as a cache line.
  struct alignas(64) Node {
    Bounds box;
    std::uint32_t begin = 0, end = 0, second = 0;
    std::uint32_t group = no_group;  // common to all its triangles, or no_group
  };
  struct Dipole {
    Point center{};
    Vec3 area{};  // sum of the triangles' normals by area
    double radius = 0;
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::span<const Point> centers,
                      base::Progress* progress);
  void group_nodes();
  void make_dipoles();
  enum class Step { past, into, found };
  // Calls enter(node), which decides how to go on, and visit(index into order_) for triangles of entered
  // leaves until it returns true. Returns whether one was found.
  template <class Enter, class Visit>
  bool find(Enter&& enter, Visit&& visit) const;

  std::vector<std::uint32_t> order_;
  std::vector<Corners> corners_;       // in that order
  std::vector<std::uint32_t> groups_;  // in that order, if there are groups
  std::vector<Node> nodes_;
  std::vector<Dipole> dipoles_;  // one per node
};

template <class Enter, class Visit>
bool TriangleTree::find(Enter&& enter, Visit&& visit) const {
  std::uint32_t stack[64];
  std::size_t size = 0;
  const auto found = [&](std::uint32_t i) {
    const Step step = enter(i);
    if (step == Step::into) stack[size++] = i;
    return step == Step::found;
  };
  if (found(0)) return true;
  while (size > 0) {
    const std::uint32_t i = stack[--size];
    const Node& node = nodes_[i];
    if (node.second != 0) {
      if (found(node.second) || found(i + 1)) return true;
      continue;
    }
    for (std::uint32_t t = node.begin; t < node.end; ++t) {
      if (visit(t)) return true;
    }
  }
  return false;
}

}  // namespace viete::mesh
