// A tree of bounding boxes for triangles: finds the nearest triangle, near triangles and winding numbers.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/surface.h"
#include "mesh/triangle.h"

namespace viete::mesh {

/// A tree of triangles. Treats a triangle without area as its longest edge, or as a point. Copies the
/// corners. Thread-safe. Lengths must be from 1e-75 to 1e75.
class TriangleTree {
public:
  /// Requires at least one triangle. `groups` is empty or has one number per position. A triangle belongs to
  /// the group of its first corner. `progress` may be null. Throws base::Cancelled.
  TriangleTree(std::span<const Point> positions, std::span<const Triangle> triangles,
               base::Progress* progress = nullptr, std::span<const std::uint32_t> groups = {});

  struct Nearest {
    std::uint32_t triangle = std::numeric_limits<std::uint32_t>::max();
    double squared_distance = std::numeric_limits<double>::infinity();
  };

  /// Returns the triangle nearest to p. If several triangles are equally near, returns the one that the
  /// search reaches first. This depends on p and on the order of the tree's nodes; it need not be the lowest
  /// index. If all squared distances are at least `below`, returns Nearest().
  Nearest nearest(const Point& p, double below = std::numeric_limits<double>::infinity()) const;

  struct NearestOfGroup {
    std::uint32_t group, triangle;
    double squared_distance;
  };
  /// For each group except `but_group`, finds the triangle nearest to p. Returns the triangles whose distance
  /// is at most `radius` and at most `times` the least distance, and maybe others within `radius`, in any
  /// order. The tree must have groups.
  std::vector<NearestOfGroup> nearest_of_groups(const Point& p, double radius, double times,
                                                std::uint32_t but_group) const;

  /// Calls visit(triangle) for each triangle whose bounding box overlaps or touches `box`.
  template <class Visit>
  void for_meeting(const Bounds& box, const Visit& visit) const {
    find([&](std::uint32_t i) { return meet(nodes_[i].box, box) ? Step::into : Step::past; },
         [&](std::uint32_t i) {
           if (meet(bounds(corners_[i]), box)) visit(order_[i]);
           return false;
         });
  }

  /// True if a triangle of the tree intersects t, or if its distance to t is less than `distance`. The test
  /// for intersection is exact. t must have a plane.
  bool is_near(const Corners& t, double distance = 0) const;

  /// Returns the generalised winding number around p, with an error of a few hundredths. A dipole replaces
  /// several distant triangles. Sources: Jacobson et al. 2013, Robust inside-outside segmentation using
  /// generalized winding numbers; Barill et al. 2018, Fast winding numbers for soups and clouds.
  double winding_number(const Point& p) const;

private:
  static constexpr auto no_group = std::numeric_limits<std::uint32_t>::max();
  // A node has the triangles order_[begin] to order_[end - 1]. The first child is the next node in nodes_.
  // The second child is nodes_[second]. In a leaf, `second` is 0.
  struct alignas(64) Node {
    Bounds box;
    std::uint32_t begin = 0, end = 0, second = 0;
    std::uint32_t group = no_group;  // the group of all triangles in the node, or no_group
  };
  struct Dipole {
    Point center{};
    Vec3 area{};  // the sum of the triangles' normals, weighted by area
    double radius = 0;
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::span<const Point> centers,
                      base::Progress* progress);
  void group_nodes();
  void make_dipoles();
  enum class Step { past, into, found };
  // Searches the tree. For each node that it reaches, calls enter(index of the node). The result `past` skips
  // the node, `into` searches the node, and `found` ends the search. In leaves, calls visit(index in order_),
  // which returns true to end the search. Returns true if the search was ended.
  template <class Enter, class Visit>
  bool find(Enter&& enter, Visit&& visit) const;

  std::vector<std::uint32_t> order_;
  std::vector<Corners> corners_;       // one per entry of order_
  std::vector<std::uint32_t> groups_;  // one per entry of order_; empty without groups
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

/// Returns the generalised winding number around p: the sum of the triangles' signed solid angles, divided by
/// 4 pi. For a closed surface oriented outward, the number is 1 inside and 0 outside. Must not be called for
/// points on the surface. Lengths must be from 1e-100 to 1e100. Sources: Jacobson et al. 2013, Robust
/// inside-outside segmentation; van Oosterom and Strackee 1983, The solid angle of a plane triangle.
double winding_number(const Surface& surface, const Point& p);

/// Returns the indices of the positions outside the cage, ascending. Outside, the absolute winding number is
/// below 0.5; the cage's orientation has no effect. Points nearer to the cage than 1e-9 * its diagonal count
/// as inside. Positions must be finite. Lengths must be from 1e-100 to 1e100. The result does not
/// depend on the pool. `pool` and `progress` may be null. Throws base::Cancelled.
std::vector<std::uint32_t> points_outside(const Surface& cage, std::span<const Point> positions,
                                          base::WorkerPool* pool = nullptr,
                                          base::Progress* progress = nullptr);

}  // namespace viete::mesh
